extends SceneTree
## Bakes a panorama into a light, for ./dev diet --acceptance: [code]-- PANORAMA LIGHT SIZE[/code].

const PanoramaFilter := preload("res://addons/lobelight/editor/light/panorama_filter.gd")


func _initialize() -> void:
	var arguments := OS.get_cmdline_user_args()
	var panorama: Texture2D = load(arguments[0])
	var request := PanoramaFilter.make_request(panorama.get_image(), arguments[2].to_int())
	var filter: Object = ClassDB.instantiate(&"LobeLightFilter")
	var light := PanoramaFilter.make_light(request, filter.call(&"filter", request))
	ResourceSaver.save(light, arguments[1], ResourceSaver.FLAG_COMPRESS)
	quit()
