"""Cells, locations and moves."""

import numpy as np
import pytest

from tlcomm_core.workspace.grid import HEADING_STEPS, Grid


def test_locations_are_the_free_centres_by_row() -> None:
    """Free cells count from the lower left, along x first."""
    grid = Grid((1.5, 1.0), 0.5, [(0.5, 0.0, 1.0, 0.5)])
    assert grid.shape == (2, 3)
    assert grid.locations_m.tolist() == [
        [0.25, 0.25], [1.25, 0.25], [0.25, 0.75], [0.75, 0.75], [1.25, 0.75],
    ]  # fmt: skip


def test_the_origin_shifts_everything() -> None:
    """Centres, boxes and queries are in the map frame."""
    grid = Grid((1.0, 1.0), 0.5, [(-2.0, 3.0, -1.5, 3.5)], (-2.0, 3.0))
    assert grid.locations_m[0].tolist() == [-1.25, 3.25]
    assert grid.location_at(-1.9, 3.1) is None
    assert grid.location_at(-1.1, 3.1) == 0


@pytest.mark.parametrize("cell_m", [0.5, 0.1, 0.3])
def test_a_box_along_cell_edges_closes_only_its_own_cells(cell_m: float) -> None:
    """A neighbour that only touches an obstacle stays free, whatever the rounding."""
    count = 9
    for low in range(count):
        for high in range(low + 1, count + 1):
            box = (low * cell_m, 0.0, high * cell_m, cell_m)
            free = Grid((count * cell_m, cell_m), cell_m, [box]).free[0]
            assert np.flatnonzero(~free).tolist() == list(range(low, high))


def test_a_box_that_covers_a_sliver_closes_the_cell() -> None:
    """Any overlap with area closes a cell; a box may reach outside or lie there."""
    boxes = [(0.4, 0.0, 0.51, 0.1), (-5.0, 0.9, 0.2, 9.0), (7.0, 7.0, 8.0, 8.0)]
    grid = Grid((1.5, 1.0), 0.5, boxes)
    assert grid.free.tolist() == [[False, False, True], [False, True, True]]


def test_what_is_left_over_beyond_whole_cells_is_outside() -> None:
    """A size of two and a half cells makes two."""
    grid = Grid((1.25, 0.5), 0.5)
    assert grid.shape == (1, 2)
    assert not grid.contains(1.1, 0.25)
    assert grid.location_at(1.1, 0.25) is None


def test_points_on_the_upper_border_belong_to_the_last_cell() -> None:
    """The grid is closed: its upper right corner lies in its last cell."""
    grid = Grid((1.0, 1.0), 0.5)
    assert grid.location_at(1.0, 1.0) == 3
    assert grid.location_at(1.0001, 1.0) is None
    assert grid.location_at(-0.0001, 0.0) is None


def test_locations_within_a_disc_include_its_rim() -> None:
    """Centres exactly at the radius count, those beyond don't."""
    grid = Grid((2.5, 0.5), 0.5)
    assert grid.locations_within(1.25, 0.25, 0.5).tolist() == [1, 2, 3]
    assert grid.near(0, 1.0).tolist() == [True, True, True, False, False]


def test_moves_cut_no_corner() -> None:
    """A diagonal needs both cells beside it, a straight only its own."""
    grid = Grid((1.0, 1.0), 0.5, [(0.5, 0.0, 1.0, 0.5)])
    # Locations: 0 lower left, 1 upper left, 2 upper right.
    assert grid.moves.tolist() == [
        [-1, -1, 1, -1, -1, -1, -1, -1],
        [2, -1, -1, -1, -1, -1, 0, -1],
        [-1, -1, -1, -1, 1, -1, -1, -1],
    ]


def test_moves_follow_the_heading_steps() -> None:
    """In the middle of 3 × 3 free cells, move k leads to the cell at step k."""
    moves = Grid((1.5, 1.5), 0.5).moves[4]
    assert moves.tolist() == [4 + dx + 3 * dy for dx, dy in HEADING_STEPS]


def test_components_tell_what_is_cut_off() -> None:
    """A wall, or a gap through a corner alone, separates components."""
    grid = Grid((1.0, 1.0), 0.5, [(0.5, 0.0, 1.0, 0.5), (0.0, 0.5, 0.5, 1.0)])
    assert grid.components[0] != grid.components[1]
    assert len(set(Grid((5.0, 5.0), 0.5).components.tolist())) == 1


def test_everything_shared_is_read_only() -> None:
    """No caller can change the grid under another."""
    grid = Grid((1.0, 1.0), 0.5, [(0.0, 0.0, 0.5, 0.5)])
    for array in (grid.free, grid.boxes, grid.locations_m, grid.moves, grid.components):
        assert not array.flags.writeable


def test_a_disc_touches_the_cells_that_it_shares_area_with() -> None:
    """Neither those whose edge or corner it only reaches, nor those that its box covers alone."""
    grid = Grid((2.5, 2.5), 0.5)
    touched = grid.touched_by(1.25, 1.25, 0.25)
    assert touched.tolist() == [12]
    assert grid.touched_by(1.25, 1.25, 0.26).tolist() == [7, 11, 12, 13, 17]
    assert grid.touched_by(1.25, 1.25, 0.36).tolist() == [6, 7, 8, 11, 12, 13, 16, 17, 18]
    assert grid.touched_by(9.0, 9.0, 1.0).tolist() == []


def test_avoiding_closes_moves_and_keeps_the_numbering() -> None:
    """No move leads to, from or past the corner of what is avoided."""
    grid = Grid((1.5, 1.5), 0.5)
    avoiding = grid.avoiding({"middle": np.array([4])})
    np.testing.assert_array_equal(avoiding.locations_m, grid.locations_m)
    assert avoiding.location_at(0.75, 0.75) == 4
    assert (avoiding.moves[4] == -1).all()
    assert 4 not in avoiding.moves
    assert 3 not in avoiding.moves[1]
    assert avoiding.components[0] == avoiding.components[8] != avoiding.components[4]
    assert list(avoiding.avoided) == ["middle"]
    assert (grid.avoiding({"a": np.array([0])}).avoiding({}).moves == grid.moves).all()


def test_grids_of_the_same_cells_find_their_locations_in_each_other() -> None:
    """What is closed in the other one has none there."""
    grid = Grid((1.5, 1.0), 0.5, [(0.5, 0.0, 1.0, 0.5)])
    other = Grid((1.5, 1.0), 0.5, [(1.0, 0.5, 1.5, 1.0)])
    assert grid.numbers_in(other).tolist() == [0, 2, 3, 4, -1]
    for number, there in enumerate(grid.numbers_in(other).tolist()):
        if there >= 0:
            assert other.locations_m[there].tolist() == grid.locations_m[number].tolist()


def test_moves_lead_within_what_is_connected() -> None:
    """Not out of a closed cell or from outside, nor to what a wall cuts off, nor to none."""
    grid = Grid((2.5, 0.5), 0.5, [(1.0, 0.0, 1.5, 0.5)])
    assert grid.leads(0.1, 0.1, 1)
    assert not grid.leads(0.1, 0.1, 2)
    assert not grid.leads(1.2, 0.1, 1)
    assert not grid.leads(-1.0, 0.1, 1)
    assert not grid.leads(0.1, 0.1, -1)


@pytest.mark.parametrize(
    ("points_m", "is_clear"),
    [
        ([(0.25, 0.25), (0.75, 0.25), (0.75, 1.75)], True),
        ([(0.25, 1.25), (1.75, 1.25)], False),
        # Past a corner of what is closed, and along its edge.
        ([(0.75, 0.75), (1.25, 0.25)], True),
        ([(0.75, 1.25), (1.25, 0.75)], False),
        ([(1.0, 0.25), (1.0, 1.75)], False),
        ([(0.75, 0.25), (0.75, 1.75)], True),
        # From within what is closed, or nowhere.
        ([(1.25, 1.25), (1.25, 0.25)], False),
        ([(0.3, 0.3), (0.3, 0.3)], True),
        ([(0.3, 0.3)], True),
        # Other corners of a way count as well.
        ([(0.25, 0.25), (1.75, 0.25), (1.75, 1.25), (0.25, 1.25)], False),
    ],
)
def test_a_way_is_clear_if_it_touches_nothing_closed(
    points_m: list[tuple[float, float]], is_clear: bool
) -> None:
    """As moves do, it cuts no corner."""
    grid = Grid((2.0, 2.0), 0.5, [(1.0, 1.0, 1.5, 1.5)])
    assert grid.is_clear(points_m) is is_clear
    shifted = Grid((2.0, 2.0), 0.5, [(11.0, -4.0, 11.5, -3.5)], (10.0, -5.0))
    assert shifted.is_clear([(x_m + 10.0, y_m - 5.0) for x_m, y_m in points_m]) is is_clear
