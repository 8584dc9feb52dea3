"""Reads the sidecar FILE.names.json of an exported FILE, which describes its sets and materials."""
import json

GRAVITY = 0.04 * 9810  # mm/s^2; in its fluid, a brain has about 4 % of its weight


class Sidecar:
    def __init__(self, file):
        with open(file + ".names.json", encoding="utf-8") as stream:
            content = json.load(stream)
        self.sets = {entry["name"]: entry for entry in content["sets"]}
        self.sections = content["sections"]
        self.materials = {material["name"]: material for material in content["materials"]}

    def face_tags(self, surfaces):
        """Returns the numbers of the faces of these surfaces, for formats in which every face has one number."""
        return sorted({tag for name in surfaces for tag in self.sets[name]["faceTags"]})

    def material_of_tissues(self):
        """Maps labels to materials."""
        return {self.sets[section["elements"]]["ids"][0]: self.materials[section["material"]]
                for section in self.sections}


def lame(material):
    """Returns the first Lame constant and the shear modulus (MPa) of a material."""
    young, poisson = material["youngsModulus"], material["poissonsRatio"]
    return young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))
