"""Judges values by JSON Schemas as far as ours go; an unknown keyword is an error, so that nothing is passed over."""
import json
import os
import re

from tests.wire import peer

DIRECTORY = os.path.join(peer.SOURCE, "protocol", "schemas")
TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "null": type(None)}
IGNORED = {"$schema", "title", "description", "definitions"}
documents = {}


def document(name):
    if name not in documents:
        with open(os.path.join(DIRECTORY, name), encoding="utf-8") as file:
            documents[name] = json.load(file)
        for part, schema in documents[name].get("components", {}).get("schemas", {}).items():
            if schema == {"$ref": f"{part}.schema.json"}:
                documents[name]["components"]["schemas"][part] = embedded(document(f"{part}.schema.json"), part)
    return documents[name]


def embedded(value, name):
    """A schema as it stands in the components of an OpenRPC document."""
    if isinstance(value, dict):
        return {key: moved(each, name) if key == "$ref" else embedded(each, name) for key, each in value.items()}
    return [embedded(element, name) for element in value] if isinstance(value, list) else value


def moved(reference, name):
    file, _, pointer = reference.partition("#")
    return f"#/components/schemas/{file.split('.')[0] or name}{pointer}"


def references(value):
    if isinstance(value, dict):
        yield from (value[key] for key in value if key == "$ref" and isinstance(value[key], str))
    for element in value.values() if isinstance(value, dict) else value if isinstance(value, list) else ():
        yield from references(element)


def resolved(reference, home):
    file, _, pointer = reference.partition("#")
    home = document(file) if file else home
    schema = home
    for part in filter(None, pointer.split("/")):
        schema = schema[int(part) if isinstance(schema, list) else part]
    return schema, home


def is_type(value, name):
    if name in ("number", "integer"):
        return isinstance(value, (int, float)) and not isinstance(value, bool) and (name == "number" or value == int(value))
    return isinstance(value, TYPES[name])


def fault(value, schema, home, where=""):
    """What is wrong with the value, or None."""
    for keyword, asked in schema.items():
        wrong = None
        if keyword == "$ref":
            wrong = fault(value, *resolved(asked, home), where)
        elif keyword == "type":
            names = asked if isinstance(asked, list) else [asked]
            wrong = None if any(is_type(value, name) for name in names) else f"{where}: {value!r:.80} is no {asked}"
        elif keyword in ("enum", "const"):
            wrong = None if value in (asked if keyword == "enum" else [asked]) else f"{where}: {value!r:.80} is not {asked}"
        elif keyword in ("oneOf", "anyOf"):
            fits = sum(fault(value, each, home, where) is None for each in asked)
            wrong = None if fits == 1 or keyword == "anyOf" and fits else f"{where}: {fits} alternatives fit"
        elif keyword == "required":
            missing = [name for name in asked if name not in value]
            wrong = f"{where}: {missing} missing" if missing else None
        elif keyword == "properties":
            wrong = next((w for name, each in asked.items() if name in value
                          if (w := fault(value[name], each, home, f"{where}/{name}"))), None)
        elif keyword == "additionalProperties":
            others = [name for name in value if name not in schema.get("properties", {})] if isinstance(value, dict) else []
            if asked is False:
                wrong = f"{where}: {others} unknown" if others else None
            elif isinstance(asked, dict):
                wrong = next((w for name in others if (w := fault(value[name], asked, home, f"{where}/{name}"))), None)
        elif keyword == "items":
            wrong = next((w for i, each in enumerate(value) if (w := fault(each, asked, home, f"{where}/{i}"))), None)
        elif keyword in ("minItems", "minLength", "minProperties"):
            wrong = f"{where}: too short" if len(value) < asked else None
        elif keyword in ("maxItems", "maxLength", "maxProperties"):
            wrong = f"{where}: too long" if len(value) > asked else None
        elif keyword in ("minimum", "maximum", "exclusiveMinimum"):
            number = isinstance(value, (int, float))
            wrong = f"{where}: {value} out of range" if number and (
                value < asked if keyword == "minimum" else value > asked if keyword == "maximum" else value <= asked) else None
        elif keyword == "pattern":
            wrong = None if re.search(asked, value) else f"{where}: {value!r} does not match"
        elif keyword == "propertyNames":
            wrong = next((w for name in value if (w := fault(name, asked, home, where))), None)
        elif keyword == "dependencies":
            wrong = next((f"{where}: {name} without {others}" for name, others in asked.items()
                          if name in value and not all(other in value for other in others)), None)
        elif keyword == "not":
            wrong = None if fault(value, asked, home, where) else f"{where}: what must not be"
        elif keyword not in IGNORED:
            raise NotImplementedError(keyword)
        if wrong:
            return wrong
    return None
