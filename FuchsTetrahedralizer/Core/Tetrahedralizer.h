// SPDX-License-Identifier: Apache-2.0
#pragma once
/// From the surface of all tissues to a finite-element mesh of near-regular tetrahedra: Fuchs's lattice between the
/// surface's triangles by constrained Delaunay, improvement, child and parent, constitutive classes (Audette et al.,
/// Computer Aided Surgery 12(1), 2007).

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

/// L(x), mm. A scale volume also gives the frame to improve the mesh in: its own, in which copies of all inputs that
/// lie elsewhere in the world have the same numbers.
struct TargetLengths
{
  SizingFunction inWorld;
  SizingFunction inFrame; ///< the same as inWorld without a frame
  std::optional<Grid> frame;
};

TargetLengths lengthsOf(const SizingFunction& inWorld);
TargetLengths lengthsOf(const ScaleField& scale);

/// What is to be filled, in world coordinates.
struct TetrahedralizerInput
{
  SurfaceComplex surface; ///< as fillableSurface() returns it; with background tetrahedra, exactly their interface
  TissueTable tissues;
  std::string name;                   ///< of its file, for messages
  std::optional<MeshFile> background; ///< tetrahedra on both sides of the surface, as the surface stage leaves them
};

struct TetrahedralizerOptions
{
  double featureAngle = 0; ///< degrees, see TetrahedraImprovementOptions; not used with background tetrahedra
  VertexPlacement placement = VertexPlacement::Lattice; ///< of what is laid inside the surface
  ConstitutiveRule constitutive;
  CurveNetwork curves; ///< to be chains of edges, see insertCurves
};

struct FiniteElementMesh
{
  MeshFile content;   ///< tetrahedra of tissues alone, with every array but those of parts, and the curves
  SubMeshes division; ///< into child and parent
};

/// Fills the surface: with the lattice and constrained Delaunay, or with the background tetrahedra and the lattice
/// inside the tissues that have room for it, unless that leaves bad angles there; then improves all of them towards the
/// target lengths. Every tissue keeps its topology. Deterministic, whatever the number of threads. Throws SurfaceRefused
/// (see tetrahedralize), InputError where a curve leaves the tissues, EngineError.
FiniteElementMesh tetrahedralizeTissues(TetrahedralizerInput input, const TargetLengths& lengths,
                                        const TetrahedralizerOptions& options, const Progress& progress = {});

} // namespace surgicalmesher
