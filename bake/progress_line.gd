class_name ProgressLine
extends RefCounted
## Shows how far a long step is: one line that is rewritten on a terminal, a line every quarter
## elsewhere. Everything goes to standard error, so that a command's output stays clean. Nothing is
## written before the first [method show].

var _label: String
var _started := Time.get_ticks_msec()
var _terminal := OS.get_environment("LOBELIGHT_TERMINAL") == "1"
var _last_shown := -1


func _init(label: String) -> void:
	_label = label


## [param fraction] is 0 to 1.
func show(fraction: float) -> void:
	var percent := int(clampf(fraction, 0.0, 1.0) * 100.0)
	var step := percent if _terminal else percent / 25
	if step == _last_shown:
		return
	_last_shown = step
	var seconds := (Time.get_ticks_msec() - _started) / 1000.0
	var left := ""
	if fraction > 0.05 and fraction < 1.0:
		left = ", %d s left" % ceili(seconds * (1.0 - fraction) / fraction)
	_write("%s %d %%%s" % [_label, percent, left], false)


## Ends the line, with the time the step took.
func finish() -> void:
	_write("%s done in %.1f s" % [_label, (Time.get_ticks_msec() - _started) / 1000.0], true)


func _write(line: String, last: bool) -> void:
	if _terminal:
		printraw("\r\u001b[K", line, "\n" if last else "")
	else:
		printerr(line)
