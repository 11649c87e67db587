"""Options that diagrams have everywhere."""

from __future__ import annotations

from typing import Any, Optional


def diagram_options(
    precision: str = "auto",
    neighbors: str = "auto",
    decisions: str = "exact",
    certify: bool = False,
    threads: int = 0,
    chunk_pairs: int = 0,
    initial_neighbors: int = 0,
    lift_eta: Optional[float] = None,
    twin_queries: bool = True,
    keep_mesh: bool = False,
) -> dict[str, Any]:
    return {
        "precision": precision,
        "neighbors": neighbors,
        "decisions": decisions,
        "certify": certify,
        "threads": threads,
        "chunk_pairs": chunk_pairs,
        "initial_neighbors": initial_neighbors,
        "lift_eta": lift_eta,
        "twin_queries": twin_queries,
        "keep_mesh": keep_mesh,
    }
