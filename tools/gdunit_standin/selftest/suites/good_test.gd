extends GdUnitTestSuite

const CASES := [[1, 2], [2, 4], [3, 6]]

var _prepared := 0


func before() -> void:
	_prepared += 1


func before_test() -> void:
	_prepared += 1


func test_numbers() -> void:
	assert_int(_prepared).is_equal(2).is_greater(1).is_between(0, 2)
	assert_float(0.5).is_equal_approx(0.6, 0.11)
	assert_float(NAN).is_not_equal(NAN)


func test_doubles(value: int, expected: int, _test_parameters := CASES) -> void:
	assert_int(2 * value).is_equal(expected)


func test_contents() -> void:
	assert_array(PackedInt32Array([1, 2])).is_equal([1, 2]).contains(2).not_contains([3])
	assert_array([3, 1]).contains_exactly_in_any_order(1, 3).has_size(2)
	assert_dict({"a": [1, {}]}).is_equal({"a": [1, {}]}).contains_keys(["a"])
	assert_str("lobe").starts_with("lo").contains("ob").has_length(4)
	assert_vector(Vector3(1, 2, 3)).is_equal_approx(Vector3(1, 2, 3.1), Vector3.ONE * 0.2)
	assert_object(self).is_instanceof(Node).is_not_null()
	assert_that(true).is_equal(true)
	assert_bool(is_failure()).is_false()


func test_awaits() -> void:
	await await_idle_frame()
	await await_millis(10)
	assert_object(auto_free(Node.new())).is_not_null()


func test_expected_reports() -> void:
	await assert_error(func() -> void: push_error("expected")).is_push_error("expected")
	await assert_error(func() -> void: push_warning("mild")).is_push_warning("mild")
	await assert_error(func() -> void: pass).is_success()


func test_signal() -> void:
	get_tree().create_timer(0.05).timeout.connect(emit_signal.bind("renamed"))
	await assert_signal(self).is_emitted("renamed")
	await assert_signal(self).wait_until(50).is_not_emitted("renamed")


func test_skipped(_do_skip := true, _skip_reason := "shows that skipping works") -> void:
	fail("must not run")
