#!/usr/bin/python3
"""Gmsh: prints what it finds in a file. usage: run_gmsh.py mesh.msh

Prints the numbers of elements and nodes of every physical group, the number of Gmsh's warnings and errors, and the
worst quality of an element by Gmsh's own measure (the inverse condition number; for a tetrahedron, 1 if it is regular
and 0 if it is flat).
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
