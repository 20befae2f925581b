@tool
extends VisualShaderNodeCustom
## What the nodes [i]Lobelight[/i] of visual shaders have in common. Their code calls the functions
## of lobelight.gdshaderinc.
##
## A [VisualShader] keeps its nodes, not the code that they make: whoever loads one needs these
## files, games too.

## Ends the lines that ask for round lobes, whatever the pixel.
const ROUND := "// LOBELIGHT_ROUND"
## The inputs of surfaces, in the order of [method _list_inputs].
const NORMAL := 0
const TANGENT := 1
const ROUGHNESS := 2
const ANISOTROPY := 3
const PIXELS_NORMAL := "LOBELIGHT_NODE_NORMAL"

const _INCLUDE := preload("nodes.gdshaderinc")
# What the engine calls a value that was typed.
const _TYPED := "n_in"


## An input. One without a value is the pixel's own where nothing is connected.
class Port:
	extends RefCounted

	var name: String
	var type: VisualShaderNode.PortType
	var value: Variant
	## What it is in code that knows nothing of it.
	var own: String

	func _init(
		named: String, of_type: VisualShaderNode.PortType, typed: Variant, otherwise: String
	) -> void:
		name = named
		type = of_type
		value = typed
		own = otherwise

	static func vector(named: String, otherwise: String) -> Port:
		return Port.new(named, VisualShaderNode.PORT_TYPE_VECTOR_3D, null, otherwise)

	static func colour(named: String, grey: float) -> Port:
		return Port.new(
			named, VisualShaderNode.PORT_TYPE_VECTOR_3D, grey * Vector3.ONE, "vec3(%.5f)" % grey
		)

	static func number(named: String, typed: float) -> Port:
		return Port.new(named, VisualShaderNode.PORT_TYPE_SCALAR, typed, "%.5f" % typed)


# The editor asks for the values by itself, scripts that make nodes do not. Those of a file are
# there before the script is.
func _init() -> void:
	var ports := _list_inputs()
	for port in ports.size():
		if ports[port].value != null and get_input_port_default_value(port) == null:
			set_input_port_default_value(port, ports[port].value)


static func _list_surface_inputs() -> Array[Port]:
	return [
		Port.vector("normal", PIXELS_NORMAL),
		Port.vector("tangent", "LOBELIGHT_NODE_TANGENT"),
		Port.number("roughness", 0.5),
		Port.number("anisotropy", 0.0),
	]


func _list_inputs() -> Array[Port]:
	return []


# All of them are of three dimensions.
func _list_outputs() -> PackedStringArray:
	return ["radiance", "emission"]


func _get_category() -> String:
	return "Lobelight"


func _get_return_icon_type() -> PortType:
	return PORT_TYPE_VECTOR_3D


func _get_input_port_count() -> int:
	return _list_inputs().size()


func _get_input_port_name(port: int) -> String:
	return _list_inputs()[port].name


func _get_input_port_type(port: int) -> PortType:
	return _list_inputs()[port].type


func _get_input_port_default_value(port: int) -> Variant:
	return _list_inputs()[port].value


func _get_output_port_count() -> int:
	return _list_outputs().size()


func _get_output_port_name(port: int) -> String:
	return _list_outputs()[port]


func _get_output_port_type(_port: int) -> PortType:
	return PORT_TYPE_VECTOR_3D


func _get_global_code(_mode: Shader.Mode) -> String:
	return '#include "%s"' % _INCLUDE.resource_path


# What surfaces send to the viewer is known in fragment() alone.
func _is_available(mode: Shader.Mode, type: VisualShader.Type) -> bool:
	return mode == Shader.MODE_SPATIAL and type == VisualShader.TYPE_FRAGMENT


## The inputs in code. The engine gives names of variables, empty where there is no value.
func _complete(given: Array[String]) -> PackedStringArray:
	var complete: PackedStringArray = []
	var ports := _list_inputs()
	for port in ports.size():
		var is_unit := port == NORMAL and not given[port].is_empty()
		complete.append("normalize(%s)" % given[port] if is_unit else given[port])
		if given[port].is_empty():
			complete[port] = ports[port].own
	return complete


## Whether a variable that the engine gave is what another node says.
static func _is_connected(given: String) -> bool:
	return not given.is_empty() and not given.begins_with(_TYPED)


## What ends a line that asks for lobes.
func _mark(given: Array[String]) -> String:
	var typed: Variant = get_input_port_default_value(ANISOTROPY)
	var is_zero := typed == null or float(typed) == 0.0
	return ROUND if is_zero and not _is_connected(given[ANISOTROPY]) else ""


## The two outputs of linear radiance.
static func _write(light: String, mark: String, outputs: Array[String]) -> String:
	return (
		"vec3 lobelight_light = %s;%s\n%s = lobelight_light;\n%s = lobelight_emission(lobelight_light);"
		% [light, " " + mark if mark else "", outputs[0], outputs[1]]
	)
