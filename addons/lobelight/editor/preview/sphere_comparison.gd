@tool
extends VBoxContainer
## A sphere drawn with a table's lobes, as a game draws it, beside the reference that the library
## integrates by brute force, in an environment of choice.

const FormRow := preload("../bake/form_row.gd")
const NativeLibrary := preload("../bake/native_library.gd")
const PanoramaLight := preload("panorama_light.gd")
const SphereView := preload("sphere_view.gd")
const Studio := preload("studio.gd")

# Of the median of what is lit.
const _EXPOSED := 0.18
# Squared radius: what is beyond is the sphere's edge.
const _RIM := 0.9

## Samples of the BRDF for each pixel of the reference, and as many of the environment.
var samples := 512

var _table: LobeTable
var _brdf := ""
var _path := ""
var _light: LobeLight
var _reference: RefCounted
var _sphere := SphereView.new()
var _picture := TextureRect.new()
var _environment := FormRow.make_choice(["Studio", "File …"])
var _render := Button.new()
var _status := Label.new()
var _dialog: EditorFileDialog


func _init() -> void:
	_environment.tooltip_text = "What lights the spheres: a built-in studio, or a panorama."
	add_child(FormRow.make("Environment", _environment, _environment.tooltip_text))
	var pictures := HBoxContainer.new()
	_picture.expand_mode = TextureRect.EXPAND_IGNORE_SIZE
	_picture.stretch_mode = TextureRect.STRETCH_KEEP_ASPECT_CENTERED
	_picture.size_flags_horizontal = SIZE_EXPAND_FILL
	# The pictures share the width, however little there is.
	_sphere.least_size.x = 0.0
	_sphere.tooltip_text = "Drawn with the table's lobes, one fetch each."
	_picture.tooltip_text = "The reference: the BRDF integrated with many samples."
	pictures.add_child(_sphere)
	pictures.add_child(_picture)
	add_child(pictures)
	_render.text = "Compare with Reference"
	_render.tooltip_text = "Integrates the BRDF by brute force in the background."
	add_child(_render)
	_status.autowrap_mode = TextServer.AUTOWRAP_WORD_SMART
	add_child(_status)
	# Another file may follow the first.
	_environment.allow_reselect = true
	_environment.item_selected.connect(_on_environment)
	_render.pressed.connect(render_reference)
	set_process(false)


func _ready() -> void:
	_choose(Studio.find_path())


func _exit_tree() -> void:
	# Stops the work.
	_reference = null
	set_process(false)


## Shows a table's lobes; the reference is of [param brdf], as [LobeReference] takes it.
func show_table(table: LobeTable, brdf: String) -> void:
	_table = table
	_brdf = brdf
	_reference = null
	_picture.texture = null
	_status.text = ""
	var material := LobeMaterial3D.new()
	material.metallic = 1.0
	material.table = table
	_sphere.material_3d = material
	if _light != null:
		_sphere.set_light(_light)
	_render.disabled = brdf.is_empty() or not NativeLibrary.is_loaded()


## Begins the reference picture; it appears when it is done.
func render_reference() -> void:
	_status.text = ""
	_reference = NativeLibrary.create(&"LobeReference")
	var request := {
		"env": _path,
		"brdf": _brdf,
		"alpha": _table.alpha,
		"size": SphereView.SIZE,
		"samples": samples,
	}
	if not _reference.call("start", request):
		_status.text = _reference.call("get_error")
		_reference = null
	set_process(_reference != null)


## What is said below the spheres.
func get_status() -> String:
	return _status.text


func get_reference_texture() -> Texture2D:
	return _picture.texture


func _process(_delta: float) -> void:
	if _reference == null:
		set_process(false)
		return
	if _reference.call("is_running"):
		_status.text = (
			"Reference: %d %%" % roundi(100.0 * (_reference.call("get_progress") as float))
		)
		return
	var result: Dictionary = _reference.call("get_result")
	var problem: String = _reference.call("get_error")
	_reference = null
	set_process(false)
	if result.is_empty():
		_status.text = problem
	else:
		_show_reference(result["pixels"])


func _show_reference(pixels: PackedFloat32Array) -> void:
	var exposure := find_exposure(pixels)
	if exposure <= 0.0:
		_status.text = "The sphere is all but black in this environment."
		return
	var reference := to_picture(pixels, exposure)
	_picture.texture = ImageTexture.create_from_image(reference)
	if _light == null:
		return
	_light.energy = exposure
	_sphere.set_light(_light)
	await _sphere.draw_picture()
	if not is_inside_tree():
		return
	_status.text = (
		"Left: %d lobes, %.1f dB to the reference on the right, at 8 bits."
		% [_table.lobe_count, find_psnr(_sphere.get_picture(), reference)]
	)


func _on_environment(index: int) -> void:
	if index == 0:
		_choose(Studio.find_path())
		return
	if _dialog == null:
		_dialog = EditorFileDialog.new()
		_dialog.file_mode = EditorFileDialog.FILE_MODE_OPEN_FILE
		_dialog.access = EditorFileDialog.ACCESS_FILESYSTEM
		_dialog.add_filter("*.exr,*.hdr", "Panoramas")
		_dialog.file_selected.connect(_choose)
		_dialog.canceled.connect(_show_choice)
		add_child(_dialog)
	_dialog.popup_file_dialog()


func _show_choice() -> void:
	_environment.selected = 0 if _path == Studio.find_path() else 1


func _choose(path: String) -> void:
	_path = path
	_picture.texture = null
	_status.text = ""
	if path.is_empty():
		return
	var maker := PanoramaLight.new()
	var light := await maker.make(path)
	if not is_inside_tree() or path != _path:
		return
	_light = light
	if light == null:
		_status.text = maker.error
	elif _table != null:
		_sphere.set_light(light)


## The factor that brings the median of the sphere's radiance to middle grey; 0 if it is black.
static func find_exposure(pixels: PackedFloat32Array) -> float:
	var values: PackedFloat32Array = []
	for pixel in _pixels_of_the_sphere():
		var mean := (pixels[3 * pixel] + pixels[3 * pixel + 1] + pixels[3 * pixel + 2]) / 3.0
		values.append(mean)
	values.sort()
	@warning_ignore("integer_division")
	var median := values[values.size() / 2]
	return _EXPOSED / median if median > 1e-6 else 0.0


## Linear radiance as the engine shows it without tone mapping; beside the sphere it is transparent.
static func to_picture(pixels: PackedFloat32Array, exposure: float) -> Image:
	var size := SphereView.SIZE
	var picture := Image.create_empty(size, size, false, Image.FORMAT_RGBA8)
	for pixel in size * size:
		var place := _place(pixel)
		if place.length_squared() <= 1.0:
			var linear := Color(pixels[3 * pixel], pixels[3 * pixel + 1], pixels[3 * pixel + 2])
			var color := (linear * exposure).clamp().linear_to_srgb()
			color.a = 1.0
			@warning_ignore("integer_division")
			picture.set_pixel(pixel % size, pixel / size, color)
	return picture


## Decibels between two pictures of the sphere, without its edge.
static func find_psnr(picture: Image, reference: Image) -> float:
	var sum := 0.0
	var count := 0
	for pixel in _pixels_of_the_sphere():
		@warning_ignore("integer_division")
		var at := Vector2i(pixel % SphereView.SIZE, pixel / SphereView.SIZE)
		var difference := picture.get_pixelv(at) - reference.get_pixelv(at)
		sum += difference.r ** 2 + difference.g ** 2 + difference.b ** 2
		count += 3
	return -10.0 * log(maxf(sum / count, 1e-12)) / log(10.0)


static func _place(pixel: int) -> Vector2:
	var size := SphereView.SIZE
	@warning_ignore("integer_division")
	var column_and_row := Vector2(pixel % size, pixel / size)
	return (2.0 * column_and_row + Vector2.ONE) / size - Vector2.ONE


static func _pixels_of_the_sphere() -> PackedInt32Array:
	var found: PackedInt32Array = []
	for pixel in SphereView.SIZE * SphereView.SIZE:
		if _place(pixel).length_squared() < _RIM:
			found.append(pixel)
	return found
