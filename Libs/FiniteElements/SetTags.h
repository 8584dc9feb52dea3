// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Numeric tags of sets, for formats that have no names.
///
/// Tags are positive and distinct over all sets. The tag of a tissue is its label; other sets are numbered upwards from
/// the highest label. Some formats give an element only one number, although sets overlap: these formats number
/// disjoint pieces, and every set is a union of pieces. A piece that lies in a single interface has the tag of this
/// interface, so that only faces both on a tissue interface and on a sub-mesh interface or a shell have tags of their
/// own.

#include "FiniteElementModel.h"

namespace surgicalmesher
{

/// An interface, the outer boundary, a named surface or a shell. An interface is represented by the first of its two
/// sides.
struct FaceSet
{
  std::int32_t tag;
  const SetInfo* info;            ///< points into the model
  const std::vector<Cell>* cells; ///< points into the model
};

/// The faces that belong to exactly the same sets.
struct FacePiece
{
  std::int32_t tag = 0;
  std::string name;              ///< of its interface; for several, all their names joined by two underscores
  std::vector<std::size_t> sets; ///< indices into SetTags::faceSets, ascending
  std::vector<Cell> cells;       ///< point ids, oriented as in the first of these sets
};

/// The elements that belong to exactly the same sets.
struct ElementPiece
{
  std::vector<std::size_t> sets;      ///< indices into FiniteElementModel::elementSets, ascending: the tissue first
  std::vector<std::int32_t> elements; ///< ascending
};

struct SetTags
{
  std::vector<std::int32_t> elementSets; ///< per element set
  std::vector<std::int32_t> surfaces;    ///< per surface; the two sides of an interface have the same tag
  std::vector<std::int32_t> shells;      ///< per shell
  std::vector<std::int32_t> beams;       ///< per beam
  std::int32_t nullDisplacement = 0;     ///< of the set of null-displacement nodes
  std::vector<std::int32_t> fixedPoints; ///< nodes of that set, ascending; empty if there is none

  std::vector<FaceSet> faceSets; ///< tissue interfaces, sub-mesh interfaces, outer boundary, named, shells
  std::vector<FacePiece> facePieces;
  std::vector<ElementPiece> elementPieces;
};

/// Returns the tags of the sets of a model; they refer to the model, which must outlive them.
SetTags tagsOf(const FiniteElementModel& model);

/// Returns the tags of the pieces whose union is the face set with this tag, ascending.
std::vector<std::int32_t> piecesOf(const SetTags& tags, std::int32_t faceSetTag);

} // namespace surgicalmesher
