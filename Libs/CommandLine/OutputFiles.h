// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Output files that appear whole or not at all.
///
/// Each is written as `.<name>.<host>-<process>.partial<extension>` in its final folder and renamed when all are
/// complete, so that a run that ends half-way, by whatever cause, leaves nothing under a final name. A long name is
/// cut, with a hash of the whole in its place. What killed runs left in a folder is removed by the next run on the same
/// host that writes to that folder.

#include <map>
#include <set>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// ".vtp" of "a.vtp", ".nii.gz" of "a.nii.gz", ".seg.nrrd" of "a.seg.nrrd", "" of "a".
std::string fullExtension(const std::string& fileName);

/// Where a file of that name lies, or would: absolute, without symbolic links. The same file has the same place.
std::string placeOf(const std::string& file);

class OutputFiles
{
public:
  /// Where to write `finalPath` until commit(); the same for the same file. Throws InputError if the folder does not
  /// exist or can't be written to, or if the path is taken by something other than a regular file.
  std::string temporary(const std::string& finalPath);

  /// `message` with every temporary name replaced by the final one: what the user knows.
  std::string withFinalNames(std::string message) const;

  /// Renames every file into place. Throws EngineError if one was not written, InputError if the disk refuses it; no
  /// file is then left under its final name.
  void commit();

  /// The same for one file, whatever becomes of the others.
  void commit(const std::string& finalPath);

  /// Final paths of all that is in place so far.
  const std::vector<std::string>& committed() const { return m_Committed; }

  /// Removes the temporary of a file that is not to be written after all.
  void discard(const std::string& finalPath);

  OutputFiles() = default;
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;
  ~OutputFiles(); ///< removes what was not committed

private:
  std::map<std::string, std::string> m_TemporaryByFinal; ///< absolute paths
  std::set<std::string> m_CleanedFolders;
  std::vector<std::string> m_Committed;
};

} // namespace surgicalmesher
