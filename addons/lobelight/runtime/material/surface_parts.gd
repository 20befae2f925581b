@tool
extends Object
## Parts of a material's numbers: what is handed to the rendering server when one of them changes.

const TABLE := 1  ## And of the lobes, which are looked for anew.
const METAL := 2
const EMISSION := 4
const TEXTURES := 8
const COORDINATES := 16
const FADES := 32
const LAMPS := 64
const ALL := 127
