@tool
@abstract
extends RefCounted
## A search for sources, compact bright lights, in what a pyramid is made from: what a chain asks of
## live/sources/source_search.gd. Probes make none.

## Rows of its first pass, which takes the most time and may be drawn in parts.
@abstract func count_rows() -> int

## About the fetches of that pass, and of all others.
@abstract func count_fetches() -> float

@abstract func count_last_fetches() -> float

## Has rows of the first pass drawn in the next frame.
@abstract func draw_rows(first: int, count: int) -> void

## Has the other passes drawn in the next frame.
@abstract func draw_last() -> void

## After the frame: hands on what has been found.
@abstract func receive() -> void

## The viewports that draw for it.
@abstract func get_viewports() -> Array[RID]
