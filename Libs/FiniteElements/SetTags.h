// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Numbers for sets: how formats that know no names tell elements apart.
///
/// Tags are positive and differ among all sets. A tissue's tag is its label; other sets are numbered on from the
/// highest label. Some formats give an element one number only, although sets overlap: they number disjoint pieces
/// instead, of which every set is a union. A piece of one interface has the tag of this interface, so that only faces
/// on a tissue interface and a sub-mesh interface or a shell at once have a number of their own.

#include "FiniteElementModel.h"

namespace surgicalmesher
{

/// An interface, the outer boundary or a shell. Of the two sides of an interface, the first stands for both.
struct FaceSet
{
  std::int32_t tag;
  const SetInfo* info;            ///< within the model
  const std::vector<Cell>* cells; ///< within the model
};

/// The faces that belong to the same sets, and to no others.
struct FacePiece
{
  std::int32_t tag = 0;
  std::string name;              ///< of its interface; of all its interfaces and shells with two underscores between
  std::vector<std::size_t> sets; ///< indices into SetTags::faceSets, ascending
  std::vector<Cell> cells;       ///< point ids, wound as in the first of these sets
};

/// The elements that belong to the same sets, and to no others.
struct ElementPiece
{
  std::vector<std::size_t> sets;      ///< indices into FiniteElementModel::elementSets, ascending: first its tissue
  std::vector<std::int32_t> elements; ///< ascending
};

struct SetTags
{
  std::vector<std::int32_t> elementSets; ///< per element set
  std::vector<std::int32_t> surfaces;    ///< per surface; both sides of an interface have the same
  std::vector<std::int32_t> shells;      ///< per shell
  std::vector<std::int32_t> beams;       ///< per beam
  std::int32_t nullDisplacement = 0;     ///< of the set of such nodes
  std::vector<std::int32_t> fixedPoints; ///< that set, ascending; empty if there is none

  std::vector<FaceSet> faceSets; ///< tissue interfaces, sub-mesh interfaces, outer boundary, named, shells
  std::vector<FacePiece> facePieces;
  std::vector<ElementPiece> elementPieces;
};

/// Refers to the model, which must live as long.
SetTags tagsOf(const FiniteElementModel& model);

/// Tags of the pieces whose union is the face set with this tag, ascending.
std::vector<std::int32_t> piecesOf(const SetTags& tags, std::int32_t faceSetTag);

} // namespace surgicalmesher
