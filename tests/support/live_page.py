"""What a page makes of its feed, in Python."""

from collections.abc import Iterable, Mapping
from copy import deepcopy
from typing import Any

__all__ = ["grown"]


def grown(document: Mapping[str, Any], edits: Iterable[Mapping[str, Any]]) -> dict[str, Any]:
    """Return a document after some edits, fresh."""
    result = deepcopy(dict(document))
    for edit in edits:
        *way, key = edit["path"]
        owner: Any = result
        for step in way:
            owner = owner[step]
        if "items" in edit:
            assert edit["from"] <= len(owner[key]), edit
            owner[key] = [*owner[key][: edit["from"]], *edit["items"]]
        else:
            owner[key] = edit["value"]
    return result
