"""The names of classes by the types of scene files. python/make_stubs.py uses them, too, without the package."""


def class_name(section: str, kind: str) -> str:
    """Diffuse, Box, PointLight, Grid."""
    camel = "".join(word.capitalize() for word in kind.replace("-", "_").split("_"))
    return camel + "Light" if section == "lights" else camel
