"""The simulated world: unicycles, radio links, lock step."""
