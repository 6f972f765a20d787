"""Every public item explains itself."""
import inspect
import os
import re
import unittest

import halfstep as hs


def members(cls):
    for name, item in vars(cls).items():
        public = not name.startswith("_")
        if public and (callable(item) or isinstance(item, (property, classmethod))):
            yield f"{cls.__name__}.{name}", item


class Documentation(unittest.TestCase):
    def test_every_public_item_has_a_docstring(self):
        missing = [] if hs.__doc__ else ["halfstep"]
        for name in hs.__all__:
            item = getattr(hs, name)
            entries = [(name, item)] + (list(members(item)) if inspect.isclass(item) else [])
            missing += [entry for entry, what in entries
                        if len((inspect.getdoc(what) or "").strip()) < 10]
        self.assertEqual(missing, [])

    def test_quantities_have_units_or_shapes(self):
        for item in (hs.Walk.duration, hs.Walk.parameters, hs.Walk.starts, hs.Robot.mass,
                     hs.OverlapProgram.x0, hs.OverlapProgram.jacobian, hs.Result.duration):
            text = inspect.getdoc(item.fget if isinstance(item, property) else item)
            self.assertRegex(text, r"\[(s|m|kg)\]|\((n|m|m×n)\)")

    def test_families_of_parameters_are_named(self):
        families = list(hs.Experiment("fig3_two_half_steps").planned.parameters)
        for function in (hs.Experiment.walk, hs.SmoothingProblem.walk):
            self.assertEqual(list(inspect.signature(function).parameters)[1:], families)
        for item in (hs.Experiment.walk, hs.SmoothingProblem.walk, hs.Walk.parameters.fget):
            for name in families:
                self.assertRegex(inspect.getdoc(item), rf"(?m)^\s*{name} \(n")
        flags = inspect.signature(hs.OverlapProgram).parameters
        for name in ("heights", "footsteps"):
            self.assertIn(name, flags)
        self.assertNotIn("flags", flags)

    def test_public_functions_have_types(self):
        for name in hs.__all__:
            item = getattr(hs, name)
            functions = [(name, item)] if inspect.isfunction(item) else [
                (entry, what) for entry, what in members(item) if inspect.isfunction(what)]
            for entry, function in functions:
                self.assertIn("return", function.__annotations__, entry)

    def test_the_stub_names_what_the_module_has(self):
        from halfstep import _halfstep
        path = os.path.join(os.path.dirname(hs.__file__), "_halfstep.pyi")
        with open(path, encoding="utf-8") as file:
            named = set(re.findall(r"^(?:def|class) (\w+)|^(\w+):", file.read(), re.M))
        named = {a or b for a, b in named}
        public = {name for name in vars(_halfstep) if not name.startswith("__")}
        self.assertEqual(named, public)
        self.assertTrue(os.path.exists(os.path.join(os.path.dirname(path), "py.typed")))


if __name__ == "__main__":
    unittest.main()
