"""validate.py: every example and every job of the tests keeps docs/schema/ridgeline.schema.json; of tests/rejected those that
break a rule of a single value do not. Run from the source folder. Another program than ours judges: python3-jsonschema."""

import glob
import json
import sys

import jsonschema

# Refused for what values say together, or for what is not JSON's to say.
NOT_OF_THE_SCHEMA = {
    "axis_and_angle", "hole_along_the_bore", "outer_radius_inside", "passes_descend", "passes_end_elsewhere",
    "section_angle_table_descends", "tool_axis_zero", "tool_wear_takes_the_ball", "width_and_cutting_amount", "width_missing",
    "width_twice", "work_offset_break"}


def refuse(word):
    raise ValueError(word + " is not JSON")


def documents(path):
    """Jobs and definitions of a file; nothing where it holds something else."""
    try:
        with open(path, encoding="utf-8") as file:
            document = json.load(file)
    except ValueError:
        return
    if isinstance(document, dict) and "definitions" in document:
        document = document["definitions"]
    for each in document if isinstance(document, list) else [document]:
        if isinstance(each, dict) and ("job" in each or "kind" in each) and each.get("job") != "library":
            yield each


def main():
    with open("docs/schema/ridgeline.schema.json", encoding="utf-8") as file:
        schema = json.load(file)
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    failed = kept = broken = 0
    for path in sorted(glob.glob("clients/examples/**/*.json", recursive=True) + glob.glob("tests/schema/jobs/*.json")):
        for document in documents(path):
            kept += 1
            for error in validator.iter_errors(document):
                failed += 1
                best = jsonschema.exceptions.best_match([error])
                print(f"{path}: {best.json_path}: {best.message[:300]}")
    for path in sorted(glob.glob("tests/rejected/bad_input.*.json")):
        name = path.split(".")[1]
        try:
            with open(path, encoding="utf-8") as file:
                document = json.load(file, parse_constant=refuse)
        except ValueError:
            continue  # not JSON
        broken += 1
        if validator.is_valid(document) != (name in NOT_OF_THE_SCHEMA):
            failed += 1
            print(f"{path}: the schema {'refuses it' if name in NOT_OF_THE_SCHEMA else 'has nothing against it'}")
    print(f"{kept} kept, {broken} rejected")
    return 1 if failed or kept < 40 or broken < 60 else 0


sys.exit(main())
