@tool
extends RefCounted
## Keeps a [ShaderMaterial] whose shader includes lobelight.gdshaderinc lit, see
## [method LobeLight.bind].
##
## Lights need other variants of the shader. A variant is the material's own code with #defines
## before it; it is set on the rendering server, and the material keeps its own shader. A binding
## lives as long as its connection to a signal of the material, and refers to the material weakly,
## so it keeps nothing alive.

const LightRegistry := preload("../light/light_registry.gd")
const LineChoice := preload("../material/line_choice.gd")
const ShaderVariants := preload("../light/shader_variants.gd")
const WidthsTexture := preload("../table/widths_texture.gd")

const DEFAULT_SET := "res://addons/lobelight/tables/ggx_8.res"
# Loaded here so that exported projects contain them; the other includes are those of materials.
const _INCLUDES: Array[ShaderInclude] = [
	preload("../../lobelight.gdshaderinc"),
	preload("../diffuse/diffuse.gdshaderinc"),
	preload("../line/line.gdshaderinc"),
	preload("../shaders/colour.gdshaderinc"),
	preload("../shaders/environment.gdshaderinc"),
	preload("../shaders/frame.gdshaderinc"),
	preload("../shaders/lobe_table.gdshaderinc"),
	preload("../shaders/specular.gdshaderinc"),
	preload("../shaders/widths.gdshaderinc"),
	preload("../sources/source_highlights.gdshaderinc"),
	preload("../sources/sources.gdshaderinc"),
]
# What the shader has if it includes the file.
const _LIGHT := "lobelight_environment"
const _TABLE := "lobelight_table"
const _PREFIX := "lobelight_"
# What nodes of visual shaders end the lines with that need round lobes alone
# (../visual_shader/light_node.gd).
const _ROUND := "// LOBELIGHT_ROUND"
# What they include in place of the file, which is put before the graph's parameters.
const _NODES := "res://addons/lobelight/runtime/visual_shader/nodes.gdshaderinc"
const _FILE := "res://addons/lobelight/lobelight.gdshaderinc"

# By the materials' RIDs.
static var _bindings: Dictionary[RID, WeakRef] = {}
static var _mutex := Mutex.new()
static var _asking := RegEx.create_from_string(
	"\\blobelight_(reflection|surface)\\(|#(include|define)(?!.*%s)" % _NODES.get_file()
)
static var _included := RegEx.create_from_string('(?m)^(\\s*#include\\s+")([^"]+)"')

var _material: WeakRef
var _rid: RID
# The material's own, whose changes are followed, and what is shown of it.
var _shader: Shader
var _variant: Shader
var _tables: LobeTableSet
# The rendering server's textures, kept alive.
var _texture: WidthsTexture
var _is_queued := false
var _is_told := false


static func bind(material: ShaderMaterial, tables: LobeTableSet, light: LobeLight) -> void:
	if material == null:
		push_error("LobeLight.bind: there is no material.")
		return
	if tables != null and not tables.get_problem().is_empty():
		push_error("LobeLight.bind: %s: %s" % [tables.resource_path, tables.get_problem()])
		return
	_mutex.lock()
	var binding := _find(material)
	var is_new := binding == null
	if is_new:
		binding = new()
		binding._material = weakref(material)
		binding._rid = material.get_rid()
		_bindings[binding._rid] = weakref(binding)
		# The bound argument is what keeps the binding.
		material.changed.connect(binding._follow.bind(binding))
	binding._tables = tables
	binding._is_told = false
	_mutex.unlock()
	if is_new:
		LightRegistry.add_material(binding._rid, binding._queue)
	LightRegistry.set_own_light(binding._rid, light)
	binding._queue()


static func unbind(material: ShaderMaterial) -> void:
	_mutex.lock()
	var binding := _find(material)
	_mutex.unlock()
	if binding != null:
		binding._end(material)


static func is_bound(material: ShaderMaterial) -> bool:
	_mutex.lock()
	var binding := _find(material)
	_mutex.unlock()
	return binding != null


## Whether a shader is one that the light can be handed to.
static func takes_light(shader: Shader) -> bool:
	return _NODES in shader.code or _list_parameters(shader).has(_LIGHT)


static func _find(material: ShaderMaterial) -> RefCounted:
	var known: WeakRef = _bindings.get(material.get_rid()) if material != null else null
	return known.get_ref() if known != null else null


func _notification(what: int) -> void:
	if what == NOTIFICATION_PREDELETE and _rid.is_valid():
		_forget(_rid)


# Of the material, whose shader may be another one.
func _follow(_kept: RefCounted) -> void:
	_queue()


func _queue() -> void:
	if not _is_queued:
		_is_queued = true
		_update.call_deferred()


# Of the shader, whose code may be another one.
func _read_again() -> void:
	_is_told = false
	_queue()


func _update() -> void:
	_is_queued = false
	var material: ShaderMaterial = _material.get_ref()
	if material == null or not _rid.is_valid():
		return
	_watch(material.shader)
	if _shader == null:
		_variant = null
		return
	if not takes_light(_shader):
		_show_as_written(material)
		return
	var defines := _find_defines()
	# The old variant is kept until there is another one, so that the same code is compiled once.
	var variant: Shader = null
	if _NODES in _shader.code or not defines.is_empty():
		variant = ShaderVariants.fetch(_get_code(defines))
	_variant = variant
	var parameters := _list_parameters(_get_shown())
	_give_lobes(parameters[_TABLE] if parameters.has(_TABLE) else "")
	RenderingServer.material_set_shader(_rid, _get_shown().get_rid())
	# Saved materials contain values of all parameters of their shaders, the light's as well.
	LightRegistry.apply_again(_rid)


func _get_shown() -> Shader:
	return _variant if _variant != null else _shader


func _watch(shader: Shader) -> void:
	if shader == _shader:
		return
	if _shader != null:
		_shader.changed.disconnect(_read_again)
	_shader = shader
	_is_told = false
	if _shader != null:
		_shader.changed.connect(_read_again)


# By their names, what they hold.
static func _list_parameters(shader: Shader) -> Dictionary[String, String]:
	var found: Dictionary[String, String] = {}
	for parameter: Dictionary in RenderingServer.get_shader_parameter_list(shader.get_rid()):
		found[parameter["name"]] = parameter["hint_string"]
	return found


# `kind` is that of the table's texture.
func _give_lobes(kind: String) -> void:
	var tables := _get_tables()
	if tables == null or kind.is_empty():
		return
	var is_isotropic := "3D" not in kind
	var problem := tables.get_problem()
	if problem.is_empty():
		problem = WidthsTexture.find_problem(tables.widths, is_isotropic)
	if problem.is_empty() and not is_isotropic and tables.is_isotropic():
		problem = "The set has isotropic lobes only; #define LOBELIGHT_ISOTROPIC."
	if not problem.is_empty():
		_complain("%s: %s" % [tables.resource_path, problem])
		return
	_texture = tables.get_widths_texture(is_isotropic)
	var given: Dictionary[StringName, Variant] = {
		&"lobelight_table": _texture.texture.get_rid(),
		&"lobelight_table_lookup": _texture.lookup,
		&"lobelight_widths": _texture.levels,
	}
	var line := LineChoice.new()
	given.merge(line.get_parameters_of_pixels(tables.brdf))
	for name in given:
		RenderingServer.material_set_param(_rid, name, given[name])


func _get_tables() -> LobeTableSet:
	if _tables == null and ResourceLoader.exists(DEFAULT_SET):
		_tables = load(DEFAULT_SET)
	return _tables


# The lines that the variant has before the material's own code.
func _find_defines() -> PackedStringArray:
	var defines := LightRegistry.get_defines(_rid)
	var tables := _get_tables()
	var brdf := tables.brdf if tables != null else LineChoice.DEFAULT_BRDF
	if "SOURCES" in defines:
		defines.append("SOURCES_" + LineChoice.MODELS.get(brdf, "IN_LOBES"))
	if brdf != LineChoice.DEFAULT_BRDF:
		if LineChoice.MODELS.has(brdf):
			defines.append("LINE_" + LineChoice.MODELS[brdf])
		else:
			defines.append("QUALITY 8")
	if tables != null and tables.lobe_count != 8:
		defines.append("LOBES %d" % tables.lobe_count)
	if is_round(_shader.code):
		defines.append("ISOTROPIC")
	return defines


## Whether all that asks for lobes is nodes that say so; other code may be in other files.
static func is_round(code: String) -> bool:
	if _ROUND not in code:
		return false
	for line in code.split("\n"):
		if _asking.search(line) != null and not line.ends_with(_ROUND):
			return false
	return true


func _get_code(defines: PackedStringArray) -> String:
	var code := ""
	for define in defines:
		code += "#define LOBELIGHT_%s\n" % define
	var folder := _shader.resource_path.get_slice("::", 0).get_base_dir()
	var text := _shader.code
	# The variant is no file, so that paths would lead nowhere from it.
	var at := 0
	for found in _included.search_all(text):
		var path := found.get_string(2)
		if not path.contains("://"):
			path = folder.path_join(path).simplify_path()
		code += text.substr(at, found.get_start() - at) + found.get_string(1) + path + '"'
		at = found.get_end()
	code += text.substr(at)
	if _NODES in code:
		code = code.insert(code.find(";") + 1, '\n#include "%s"' % _FILE)
	return code


# A shader that takes no light, or does not compile, which the engine has said.
func _show_as_written(material: ShaderMaterial) -> void:
	_variant = null
	RenderingServer.material_set_shader(_rid, _shader.get_rid())
	if "#include" in _shader.code and _list_parameters(_shader).is_empty():
		return
	_complain(
		(
			("the shader of %s does not include" + " res://addons/lobelight/lobelight.gdshaderinc.")
			% (material.resource_path if material.resource_path else "a material")
		)
	)


# Once, until the shader or the set is another one.
func _complain(problem: String) -> void:
	if not _is_told:
		push_error("LobeLight.bind: " + problem)
	_is_told = true


func _end(material: ShaderMaterial) -> void:
	var rid := _rid
	_forget(rid)
	_rid = RID()
	material.changed.disconnect(_follow)
	if _shader != null:
		_shader.changed.disconnect(_read_again)
	# The material's own may be another one since the last update.
	var own := material.shader
	RenderingServer.material_set_shader(rid, own.get_rid() if own != null else RID())
	for shader: Shader in [own, _variant]:
		for name in _list_parameters(shader) if shader != null else {}:
			if name.begins_with(_PREFIX):
				RenderingServer.material_set_param(rid, name, null)


static func _forget(rid: RID) -> void:
	LightRegistry.remove_material(rid)
	_mutex.lock()
	_bindings.erase(rid)
	_mutex.unlock()
