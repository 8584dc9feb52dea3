#!/usr/bin/python3
"""Gmsh: what it finds in a file. usage: run_gmsh.py mesh.msh

Prints the elements and nodes of every physical group, and the worst quality of a tetrahedron in Gmsh's own measure (the
inverse condition number; 1 for a regular one, 0 for a flat one).
"""
import re
import sys

import gmsh

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
gmsh.logger.start()
gmsh.open(sys.argv[1])
for dimension, tag in gmsh.model.getPhysicalGroups():
    entities = gmsh.model.getEntitiesForPhysicalGroup(dimension, tag)
    elements = sum(len(tags) for entity in entities for tags in gmsh.model.mesh.getElements(dimension, entity)[1])
    nodes = len(gmsh.model.mesh.getNodesForPhysicalGroup(dimension, tag)[0])
    print("group", dimension, tag, elements, nodes, gmsh.model.getPhysicalName(dimension, tag))
gmsh.plugin.setNumber("AnalyseMeshQuality", "ICNMeasure", 1)
gmsh.plugin.setNumber("AnalyseMeshQuality", "DimensionOfElements", 3)
gmsh.plugin.run("AnalyseMeshQuality")
messages = gmsh.logger.get()
print("complaints", sum(message.startswith(("Warning", "Error")) for message in messages))
print("worst_quality", *re.search(r"ICN += +([^,]+),", "\n".join(messages)).groups())
