extends SceneTree
## Bakes a panorama into a light in blocks (BC6H), for ./dev diet --acceptance: [code]-- PANORAMA
## LIGHT WIDTH[/code]. The panorama is stretched to a width.

const LightFormats := preload("res://addons/lobelight/editor/light/light_formats.gd")
const PanoramaFilter := preload("res://addons/lobelight/editor/light/panorama_filter.gd")


func _initialize() -> void:
	var arguments := OS.get_cmdline_user_args()
	var panorama := (load(arguments[0]) as Texture2D).get_image()
	var width := arguments[2].to_int()
	@warning_ignore("integer_division")
	panorama.resize(width, width / 2, Image.INTERPOLATE_BILINEAR)
	var request := PanoramaFilter.make_request(panorama)
	var filter: Object = ClassDB.instantiate(&"LobeLightFilter")
	var light := PanoramaFilter.make_light(request, filter.call(&"filter", request))
	LightFormats.convert_light(light, LightFormats.Format.BPTC)
	light.seal()
	ResourceSaver.save(light, arguments[1], ResourceSaver.FLAG_COMPRESS)
	quit()
