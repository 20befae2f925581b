extends Object
## The visual layers of the demo.

## What both halves of the picture show.
const COMMON := 1
## Objects, and the cover over the other half, of the left and the right half of the picture.
const LEFT := 1 << 1
const RIGHT := 1 << 2
const LEFT_COVER := 1 << 3
const RIGHT_COVER := 1 << 4
## The studio, which is captured.
const STUDIO := 1 << 5
## What stands for objects in the reflections of others, and is not shown.
const REFLECTED := 1 << 6
