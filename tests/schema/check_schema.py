#!/usr/bin/env python3
"""Checks the extension's JSON schemas against examples, files and the validator.

Usage: check_schema.py examples
       check_schema.py files FOLDER...
       check_schema.py agreement ZEROTREE SAMPLE.glb FOLDER

examples: the schemas are schemas, those in valid/ pass, and each in invalid/ has one defect.
files: the extension objects of all .glb and .gltf files in the folders pass.
agreement: where the schema finds a defect in an example, `zerotree validate` reports an error at
the same place of SAMPLE.glb with that extension object, written to FOLDER; and none where it does
not.
Exit code 0 if that holds.
"""
import json
import pathlib
import struct
import subprocess
import sys

try:
    import jsonschema
except ImportError:
    sys.exit("check_schema: install the Debian package python3-jsonschema")

HERE = pathlib.Path(__file__).resolve().parent
SPEC = HERE.parents[1] / "extension-spec" / "schema"
EXTENSION = "ZEROTREE_mesh_progressive"
ROOT = f"mesh.{EXTENSION}.schema.json"
PLACE = f"/meshes/0/extensions/{EXTENSION}"
# What a schema can find; other codes are of rules beyond it.
SCHEMA_CODES = {
    "ARRAY_LENGTH_NOT_IN_LIST", "ARRAY_TYPE_MISMATCH", "ATTRIBUTES_UNSUPPORTED",
    "DUPLICATE_ELEMENTS", "EMPTY_ENTITY", "INVALID_INDEX", "TYPE_MISMATCH", "UNDEFINED_PROPERTY",
    "VALUE_NOT_IN_RANGE",
}


def load_validator():
    schemas = {}
    for path in [*SPEC.glob("*.schema.json"), *(HERE / "gltf").glob("*.schema.json")]:
        schema = json.loads(path.read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        assert schema["$id"] == path.name, path
        schemas[path.name] = schema
    try:  # jsonschema from 4.18 on
        from referencing import Registry, Resource
        registry = Registry().with_resources(
            (name, Resource.from_contents(schema)) for name, schema in schemas.items())
        return jsonschema.Draft202012Validator(schemas[ROOT], registry=registry)
    except ImportError:
        resolver = jsonschema.RefResolver(ROOT, schemas[ROOT], store=schemas)
        return jsonschema.Draft202012Validator(schemas[ROOT], resolver=resolver)


def defect_places(validator, extension):
    """JSON pointers, relative to the extension object, of what the schema finds wrong."""
    return sorted({"".join(f"/{key}" for key in error.absolute_path)
                   for error in validator.iter_errors(extension)})


def examples(kind):
    paths = sorted((HERE / kind).glob("*.json"))
    assert len(paths) >= 10, f"there are {len(paths)} examples in {HERE / kind}"
    return [(path, json.loads(path.read_text())) for path in paths]


def check_examples(validator):
    failures = []
    for path, extension in examples("valid"):
        if defect_places(validator, extension):
            failures.append(f"{path}: wrong at {defect_places(validator, extension)}")
    for path, extension in examples("invalid"):
        places = defect_places(validator, extension)
        if len(places) != 1:
            failures.append(f"{path}: one defect expected, not {places}")
    return failures


def read_json(path):
    data = path.read_bytes()
    if data[:4] == b"glTF":
        data = data[20:20 + struct.unpack_from("<I", data, 12)[0]]
    return json.loads(data)


def check_files(validator, folders):
    failures, count = [], 0
    for folder in folders:
        paths = [p for p in sorted(pathlib.Path(folder).iterdir()) if p.suffix in (".glb", ".gltf")]
        for path in paths:
            for mesh in read_json(path)["meshes"]:
                count += 1
                places = defect_places(validator, mesh["extensions"][EXTENSION])
                if places:
                    failures.append(f"{path}: wrong at {places}")
    print(f"{count} extension objects")
    return failures or ([] if count else ["there are no files"])


def write_sample(sample, extension, path):
    data = sample.read_bytes()
    end = 20 + struct.unpack_from("<I", data, 12)[0]
    root = json.loads(data[20:end])
    root["meshes"][0]["extensions"][EXTENSION] = extension
    text = json.dumps(root).encode()
    text += b" " * (-len(text) % 4)
    size = 20 + len(text) + len(data) - end
    head = struct.pack("<4sIII4s", b"glTF", 2, size, len(text), b"JSON")
    path.write_bytes(head + text + data[end:])


def validate(zerotree, path):
    """Pointers, relative to the extension object, of errors that a schema could find."""
    report = path.with_suffix(".report.json")
    report.unlink(missing_ok=True)
    run = subprocess.run([zerotree, "validate", path, "-o", report], stdout=subprocess.DEVNULL)
    assert run.returncode in (0, 1), f"zerotree validate {path} ended with {run.returncode}"
    return [m["pointer"][len(PLACE):] for m in json.loads(report.read_text())["issues"]["messages"]
            if m["severity"] == 0 and m["code"] in SCHEMA_CODES and m["pointer"].startswith(PLACE)]


def is_same_place(a, b):
    """One holds the other: glTF's codes name the object that lacks a member, and whole arrays."""
    return f"{a}/".startswith(f"{b}/") or f"{b}/".startswith(f"{a}/")


def check_agreement(validator, zerotree, sample, folder):
    failures = []
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for path, extension in examples("valid") + examples("invalid"):
        glb = folder / f"{path.parent.name}_{path.stem}.glb"
        write_sample(pathlib.Path(sample), extension, glb)
        wrong, found = defect_places(validator, extension), validate(zerotree, glb)
        if bool(wrong) != bool(found) or not all(
                any(is_same_place(a, b) for b in found) for a in wrong) or not all(
                any(is_same_place(a, b) for a in wrong) for b in found):
            failures.append(f"{path}: the schema finds {wrong}, zerotree validate {found}")
    return failures


def main(arguments):
    validator = load_validator()
    if arguments == ["examples"]:
        failures = check_examples(validator)
    elif arguments[:1] == ["files"] and len(arguments) > 1:
        failures = check_files(validator, arguments[1:])
    elif arguments[:1] == ["agreement"] and len(arguments) == 4:
        failures = check_agreement(validator, *arguments[1:])
    else:
        print(__doc__, file=sys.stderr)
        return 2
    for failure in failures:
        print(f"FAILED {failure}", file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
