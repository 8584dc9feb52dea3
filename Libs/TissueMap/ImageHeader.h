// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What headers of image files say and ITK's readers do not pass on, or pass on rounded.

#include "Vec3.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace surgicalmesher
{

/// Whether the name of `file` ends with `extension`, in upper or lower case.
bool hasExtension(const std::string& file, const std::string& extension);

bool isNRRD(const std::string& file);      ///< by the extension: .nrrd or .nhdr
bool isMetaImage(const std::string& file); ///< by the extension: .mha or .mhd

/// The header of an NRRD or MetaImage file.
struct TextHeader
{
  std::map<std::string, std::string> fields; ///< by name, in lower case without blanks: "datafile"
  std::uint64_t end = 0;                     ///< where voxels in the same file begin

  std::string operator[](const std::string& name) const; ///< empty where the header lacks the field
};

TextHeader readTextHeader(const std::string& file);

/// Millimetres per unit of the lengths in an NRRD or MetaImage header (space units, DistanceUnits); 1 if it names no
/// unit. Throws InputError for units other than mm, cm, m and micrometres.
double millimetresPerUnit(const std::string& file);

/// A NIfTI-1 header. Lengths are in mm, frames are LPS.
struct NiftiHeader
{
  int qformCode = 0;
  int sformCode = 0;
  Vec3 qformOrigin;
  Vec3 sformOrigin;
  std::array<Vec3, 3> sformColumns; ///< the step from voxel to voxel along each axis
  double skew = 0;                  ///< degrees: largest deviation of two columns of the sform from a right angle
  int dataType = 0;                 ///< the standard's number of the type of the voxels in the file
  float slope = 0;                  ///< 0: voxels are not scaled, whatever the intercept
  std::uint64_t bytesBeforeVoxels = 0;
};

/// Empty unless `file`, compressed or not, or the header (.hdr) beside it, is NIfTI-1.
std::optional<NiftiHeader> readNiftiHeader(const std::string& file);

} // namespace surgicalmesher
