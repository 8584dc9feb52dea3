// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Output files that appear whole or not at all.
///
/// Each is written as `.<name>.<host>-<process>.partial<extension>` in its final folder and renamed when all are
/// complete, so that a run that ends early, for whatever reason, leaves nothing under a final name. A name that is too
/// long is cut and completed with a hash of the whole name. Temporary files of killed runs are removed by the next run
/// on the same host that writes to that folder.

#include <map>
#include <set>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// ".vtp" of "a.vtp", ".nii.gz" of "a.nii.gz", ".seg.nrrd" of "a.seg.nrrd", "" of "a".
std::string fullExtension(const std::string& fileName);

/// Returns the absolute path, without symbolic links, where `file` lies or would lie. All names of one file give the
/// same path.
std::string placeOf(const std::string& file);

class OutputFiles
{
public:
  /// Returns the path to write `finalPath` to until commit(); always the same for the same file. Throws InputError if
  /// the folder does not exist or cannot be written to, or if the path is taken by something other than a regular file.
  std::string temporary(const std::string& finalPath);

  /// Returns `message` with every temporary name replaced by the final one, which the user knows.
  std::string withFinalNames(std::string message) const;

  /// Renames every file into place. Throws EngineError if one was not written, InputError if the disk refuses it; then
  /// no file of this run is left under its final name, and earlier files are there again (as far as the file system
  /// knows hard links).
  void commit();

  /// Does the same for one file, independently of the others.
  void commit(const std::string& finalPath);

  /// Final paths of all files that are in place so far.
  const std::vector<std::string>& committed() const { return m_Committed; }

  /// Removes the temporary file of an output that is not to be written after all.
  void discard(const std::string& finalPath);

  OutputFiles() = default;
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;
  ~OutputFiles(); ///< removes the files that were not committed

private:
  std::map<std::string, std::string> m_TemporaryByFinal; ///< absolute paths
  std::set<std::string> m_CleanedFolders;
  std::vector<std::string> m_Committed;
};

/// Writes `bytes` to a file that appears whole or not at all. Throws InputError, with the file's own name, if it can't
/// be written.
void writeWhole(const std::string& bytes, const std::string& file);

} // namespace surgicalmesher
