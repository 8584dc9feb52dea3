// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Finite-element mesh of near-regular tetrahedra from the surface of all tissues: Fuchs's lattice between the
/// triangles of the surface by constrained Delaunay tetrahedralization, improvement, division into child and parent,
/// constitutive classes (Audette et al., Computer Aided Surgery 12(1), 2007).

#include "ConstitutiveTags.h"
#include "CurveNetwork.h"
#include "MeshIO.h"
#include "Progress.h"
#include "ScaleField.h"
#include "SizingFunction.h"
#include "SubMeshes.h"
#include "VertexPlacement.h"

#include <optional>
#include <string>

namespace surgicalmesher
{

/// Target edge length L(x), mm. A scale volume also gives the frame in which the mesh is improved: its own, in which
/// inputs that differ only by their position in the world have the same coordinates.
struct TargetLengths
{
  SizingFunction inWorld;
  SizingFunction inFrame; ///< L in coordinates of `frame`; the same as inWorld without a frame
  std::optional<Grid> frame;
};

TargetLengths lengthsOf(const SizingFunction& inWorld);
TargetLengths lengthsOf(const ScaleField& scale);

/// The tissues to be filled, in world coordinates.
struct TetrahedralizerInput
{
  /// As returned by fillableSurface(); with background tetrahedra, exactly their interface.
  SurfaceComplex surface;
  TissueTable tissues;
  std::string name;                   ///< of the surface's file, for messages
  std::optional<MeshFile> background; ///< tetrahedra on both sides of the surface, from the surface stage
};

struct TetrahedralizerOptions
{
  double featureAngle = 0; ///< degrees, see TetrahedraImprovementOptions; not used with background tetrahedra
  VertexPlacement placement = VertexPlacement::Lattice; ///< of the lattice points inside the surface
  ConstitutiveRule constitutive;
  CurveNetwork curves; ///< to be inserted as chains of edges, see insertCurves
};

struct FiniteElementMesh
{
  MeshFile content;   ///< tetrahedra of tissues only, with all arrays except those of parts, and the curves
  SubMeshes division; ///< into child and parent
};

/// Fills the surface with the lattice by constrained Delaunay tetrahedralization. With background tetrahedra, starts
/// from these and puts the lattice only into tissues that have room for it, unless this leaves bad angles there. Then
/// improves all tetrahedra towards the target lengths. Every tissue keeps its topology. The result does not depend on
/// the number of threads. Throws SurfaceRefused (see tetrahedralize), InputError where a curve leaves the tissues, and
/// EngineError.
FiniteElementMesh tetrahedralizeTissues(TetrahedralizerInput input, const TargetLengths& lengths,
                                        const TetrahedralizerOptions& options, const Progress& progress = {});

} // namespace surgicalmesher
