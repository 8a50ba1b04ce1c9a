"""The schema of scenes (`millstress manual schema`) takes all scenes that the program takes, and refuses what is misspelt or of
the wrong kind: tests/schema.py PROGRAM. Skipped (77) without jsonschema (Debian: python3-jsonschema).

Turns red: a key that the schema does not have, or has in one form of two; a table that takes any key; a type that is lost.
"""

import json
import subprocess
import sys
import tomllib
from pathlib import Path

try:
    import jsonschema
except ImportError:
    print("there is no jsonschema here")
    sys.exit(77)

ROOT = Path(__file__).resolve().parent.parent
# Of the program's texts, those of what a schema sees.
OF_SCHEMA = ("unknown key", " is wanted", "is out of range: a whole number", "unknown machine")


def refused_scene(file):
    """A wrong scene as tests/refused/README.md describes it, and what the program says of it."""
    text, said = file.read_text(encoding="utf-8"), []
    for line in text.splitlines():
        word, _, value = line.partition(": ")
        if word == "# BASE":
            text = (ROOT / "tests/refused/base" / value).read_text(encoding="utf-8")
        elif word == "# REPLACE":
            old, _, new = value.partition(" -> ")
            text = text.replace(old, new.replace("\\n", "\n"))
        elif word == "# EXPECT":
            said.append(value)
    return text, said


schema = json.loads(subprocess.run([sys.argv[1], "manual", "schema"], check=True, capture_output=True).stdout)
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)
faults = []

right = [*ROOT.glob("pipelines/scenes/**/*.toml"), *ROOT.glob("tests/refused/base/*.toml")]
for file in right:
    for error in validator.iter_errors(tomllib.loads(file.read_text(encoding="utf-8"))):
        faults.append(f"{file}: {'.'.join(map(str, error.absolute_path))}: {error.message[:200]}")

n_refused = 0
for file in sorted(ROOT.glob("tests/refused/*/*.toml")):
    if file.parent.name == "base":
        continue
    text, said = refused_scene(file)
    try:
        scene = tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        continue
    if not any(part in line for line in said for part in OF_SCHEMA):
        continue
    n_refused += 1
    if validator.is_valid(scene):
        faults.append(f"{file}: is accepted, of which the program says {said}")

if len(right) < 20 or n_refused < 10:
    faults.append(f"{len(right)} right and {n_refused} wrong scenes are too few to tell anything")
print(f"{len(right)} right scenes, {n_refused} wrong ones")
print("\n".join(faults))
sys.exit(1 if faults else 0)
