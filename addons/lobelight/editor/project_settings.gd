@tool
extends Object
## What the project settings say of materials, environments and probes, with defaults and ranges.

const DiffuseSource := preload("../runtime/light/diffuse_source.gd")
const EnvironmentSource := preload("../runtime/live/environment_source.gd")
const LightStore := preload("../runtime/probes/light_store.gd")
const ProbeSchedule := preload("../runtime/probes/probe_schedule.gd")


## Shows the settings in the dialog. They are stored where they are not at their defaults.
static func register() -> void:
	_add(
		LightStore.SETTING,
		LightStore.DEFAULT_SIZE,
		PROPERTY_HINT_ENUM,
		"32:32,64:64,128:128,256:256,512:512"
	)
	_add(
		LightStore.SETTING + ".mobile",
		LightStore.DEFAULT_MOBILE_SIZE,
		PROPERTY_HINT_ENUM,
		"32:32,64:64,128:128,256:256,512:512"
	)
	_add(DiffuseSource.SETTING, 0, PROPERTY_HINT_ENUM, "Automatic,Environment,Engine")
	_add(ProbeSchedule.SETTING, ProbeSchedule.DEFAULT_VIEWS, PROPERTY_HINT_RANGE, "1,6,1")
	_add(
		EnvironmentSource.BUDGET_SETTING,
		EnvironmentSource.DEFAULT_BUDGET,
		PROPERTY_HINT_RANGE,
		"0,16,0.1,or_greater,suffix:ms"
	)


static func _add(name: String, value: Variant, hint: PropertyHint, range_of_values: String) -> void:
	if not ProjectSettings.has_setting(name):
		ProjectSettings.set_setting(name, value)
	ProjectSettings.set_initial_value(name, value)
	ProjectSettings.set_as_basic(name, true)
	ProjectSettings.add_property_info(
		{"name": name, "type": typeof(value), "hint": hint, "hint_string": range_of_values}
	)
