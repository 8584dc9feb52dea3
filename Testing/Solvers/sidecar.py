"""What FILE.names.json, beside each exported FILE, says of sets and materials."""
import json

GRAVITY = 0.04 * 9810  # mm/s^2: in its fluid a brain has about 4 % of its weight


class Sidecar:
    def __init__(self, file):
        with open(file + ".names.json", encoding="utf-8") as stream:
            content = json.load(stream)
        self.sets = {entry["name"]: entry for entry in content["sets"]}
        self.sections = content["sections"]
        self.materials = {material["name"]: material for material in content["materials"]}

    def face_tags(self, surfaces):
        """Numbers of the faces of these surfaces in formats that give a face one number."""
        return sorted({tag for name in surfaces for tag in self.sets[name]["faceTags"]})

    def material_of_tissues(self):
        """Label -> material."""
        return {self.sets[section["elements"]]["ids"][0]: self.materials[section["material"]]
                for section in self.sections}


def lame(material):
    """First Lame constant and shear modulus, MPa."""
    young, poisson = material["youngsModulus"], material["poissonsRatio"]
    return young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))
