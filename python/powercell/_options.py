"""Options that diagrams have everywhere."""

from __future__ import annotations

from typing import Any


def diagram_options(
    precision: str = "auto",
    neighbors: str = "auto",
    decisions: str = "exact",
    certify: bool = False,
    threads: int = 0,
    chunk_pairs: int = 0,
) -> dict[str, Any]:
    return {
        "precision": precision,
        "neighbors": neighbors,
        "decisions": decisions,
        "certify": certify,
        "threads": threads,
        "chunk_pairs": chunk_pairs,
    }
