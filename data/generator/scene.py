"""A scene of instances that writes itself as JSON, and the models that it is made of."""
from .mesh import number


class Scene:
    def __init__(self, name, scheme):
        self.folder = name  # with the models of all its versions
        self.name = name if scheme == "loop" else f"{name}-{scheme}"
        self.scheme = scheme
        self.models = {}  # file name: Mesh
        self.objects = []  # lines of JSON
        self.materials = []
        self.instances = []
        self.view = []

    def model(self, name, mesh):
        """An object that is a mesh; the file carries the object's name and, but for Loop, the scheme's."""
        file = f"{name}.obj" if self.scheme == "loop" else f"{name}-{self.scheme}.obj"
        self.models[file] = mesh
        self.objects.append(f'"{name}": {{"model": "{self.folder}/{file}"}}')

    def group(self, name, *instances):
        """An object made of instances of others, as instance() returns them."""
        lines = ",\n".join(f"      {i}" for i in instances)
        self.objects.append(f'"{name}": {{"instances": [\n{lines}\n    ]}}')

    def material(self, name, colour, mirror=0):
        shine = f', "mirror": {number(mirror)}' if mirror else ""
        self.materials.append(f'"{name}": {{"colour": {vector(colour)}{shine}}}')

    def show(self, *arguments, **keywords):
        self.instances.append(instance(*arguments, **keywords))

    def camera(self, eye, target, fov):
        self.view.append(f'"camera": {{"eye": {vector(eye)}, "target": {vector(target)}, "fov": {number(fov)}}}')

    def light(self, position, colour):
        self.view.append(f'"lights": [{{"position": {vector(position)}, "colour": {vector(colour)}}}]')

    def background(self, colour):
        self.view.append(f'"background": {vector(colour)}')

    def text(self):
        def block(items):
            return ",\n".join(f"    {item}" for item in items)

        parts = [
            f'"scheme": "{self.scheme}"',
            f'"objects": {{\n{block(self.objects)}\n  }}',
            f'"materials": {{\n{block(self.materials)}\n  }}',
            f'"instances": [\n{block(self.instances)}\n  ]',
        ]
        return "{\n" + ",\n".join(f"  {part}" for part in parts + self.view) + "\n}\n"


def instance(name, material=None, scale=None, rotate=None, translate=None):
    """One line of JSON; scale is a number or a triple, rotate an axis and degrees."""
    steps = []
    if scale is not None:
        steps.append(f'"scale": {vector(scale) if isinstance(scale, (tuple, list)) else number(scale)}')
    if rotate is not None:
        steps.append(f'"rotate": {vector(rotate)}')
    if translate is not None:
        steps.append(f'"translate": {vector(translate)}')
    text = f'"object": "{name}"'
    if material:
        text += f', "material": "{material}"'
    if steps:
        text += f', "transform": {{{", ".join(steps)}}}'
    return f"{{{text}}}"


def vector(values):
    return "[" + ", ".join(number(x) for x in values) + "]"
