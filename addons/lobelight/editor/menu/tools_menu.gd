@tool
extends PopupMenu
## Project > Tools > Lobelight: what concerns a whole scene.

enum Item { BAKE, REPORT, CONVERT, BAKE_PROBES, CONVERT_BACK, ASK_TO_CONVERT, CREATE }

const BakeQueue := preload("../bake/bake_queue.gd")
const CreateMenu := preload("../create/create_menu.gd")
const LightBakes := preload("../light/light_bakes.gd")
const LightFile := preload("../light/light_file.gd")
const Recipe := preload("../bake/bake_recipe.gd")
const SceneConversionMenu := preload("../conversion/scene_conversion_menu.gd")
const SceneReport := preload("scene_report.gd")
const SceneUsage := preload("scene_usage.gd")
const Wording := preload("../wording.gd")

const TITLE := "Lobelight"

var _queue: BakeQueue
var _light_bakes: LightBakes
var _conversion: SceneConversionMenu
var _dialog: AcceptDialog
var _text: TextEdit


func _init(
	queue: BakeQueue = null,
	light_bakes: LightBakes = null,
	conversion: SceneConversionMenu = null,
	create: CreateMenu = null
) -> void:
	_queue = queue
	_light_bakes = light_bakes
	_conversion = conversion
	name = TITLE
	if create != null:
		var created := PopupMenu.new()
		create.fill(created)
		add_submenu_node_item("Create", created, Item.CREATE)
	add_item("Bake All Tables in This Scene", Item.BAKE)
	add_item("Bake All Probes in This Scene", Item.BAKE_PROBES)
	add_item("Report What This Scene Uses …", Item.REPORT)
	add_item("Convert Materials of This Scene to LobeMaterial3D", Item.CONVERT)
	add_item("Convert Materials of This Scene to StandardMaterial3D", Item.CONVERT_BACK)
	add_item("Convert Materials of This Scene …", Item.ASK_TO_CONVERT)
	id_pressed.connect(choose)


## Does what an item says.
func choose(item: int) -> void:
	var root := EditorInterface.get_edited_scene_root()
	match item:
		Item.BAKE:
			var count := bake_all(root)
			_say(
				(
					"Baking %s." % Wording.count(count, "table")
					if count > 0
					else "There is no table to be baked in this scene."
				)
			)
		Item.BAKE_PROBES:
			_say(bake_probes(root))
		Item.REPORT:
			_show_report(SceneReport.describe(root))
		Item.CONVERT:
			if root != null:
				_conversion.convert_nodes([root])
		Item.CONVERT_BACK:
			if root != null:
				_conversion.convert_back([root])
		Item.ASK_TO_CONVERT:
			_conversion.ask([root])


## Bakes the tables of the scene's materials of which it is known what from; how many these are.
func bake_all(root: Node) -> int:
	var count := 0
	var usage: SceneUsage = SceneUsage.of(root)
	for table in usage.tables:
		if can_bake(table):
			_queue.add(table, Recipe.from_table(table))
			count += 1
	return count


## Bakes the light of the scene's probes; what is said of it.
func bake_probes(root: Node) -> String:
	var probes := LightFile.find_probes(root)
	if probes.is_empty():
		return "There is no LobeProbe3D in this scene."
	var problem := LightFile.find_problem_of_scene(root)
	if problem:
		return problem
	var count := _light_bakes.add_all(root)
	var text := "Baking the light of %s." % Wording.count(count, "probe")
	if count < probes.size():
		var others := Wording.count(probes.size() - count, "probe")
		text += " %s of instanced scenes left: bake these there." % others
	return text


## Whether it is known what the table was baked from, and no importer bakes it.
static func can_bake(table: LobeTable) -> bool:
	if Recipe.is_imported(table):
		return false
	var recipe: Recipe = Recipe.from_table(table)
	var is_known := table.has_meta(Recipe.META) or table.brdf in Recipe.MODELS
	return is_known and recipe.get_problem().is_empty()


func _say(message: String) -> void:
	EditorInterface.get_editor_toaster().push_toast(message)


func _show_report(report: String) -> void:
	if _dialog == null:
		_dialog = AcceptDialog.new()
		_dialog.title = "What This Scene Uses"
		_text = TextEdit.new()
		_text.editable = false
		_text.custom_minimum_size = Vector2(640, 320) * EditorInterface.get_editor_scale()
		_dialog.add_child(_text)
		add_child(_dialog)
	_text.text = report
	_dialog.popup_centered()
