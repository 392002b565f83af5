#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/output/snapshot.hpp"

namespace tushar::output {

/// Makes the folder `filebase.NNN`, NNN one above the highest there is, with its parents. Returns its path.
/// FileError if it cannot be made, or if `filebase` itself exists and is not a link.
std::filesystem::path makeNextFolder(const std::filesystem::path& filebase);

/// Points the relative link `filebase` to `folder`, in one step.
void pointLink(const std::filesystem::path& filebase, const std::filesystem::path& folder);

/// Puts `text` into the file, in one step: a reader sees the old text or the new. FileError if it cannot.
void replaceFile(const std::filesystem::path& file, const std::string& text);

/// The same, and on the disk when it returns.
void replaceFileOnDisk(const std::filesystem::path& file, const std::string& text);

/// Adds `text` to the end of the file. FileError if it cannot.
void appendToFile(const std::filesystem::path& file, const std::string& text);

/// Renames a finished temporary file to its name. FileError if it cannot.
void moveInto(const std::filesystem::path& temporary, const std::filesystem::path& file);

/// Waits until a file, or the names in a folder, are on the disk. FileError if they cannot be.
void syncToDisk(const std::filesystem::path& path);

/// All of a file; none if it cannot be read.
std::optional<std::string> textOf(const std::filesystem::path& file);

/// Where a file is written before it has its name.
std::filesystem::path temporaryOf(const std::filesystem::path& file);

/// A name as part of a path, in the file system, in HDF5 or in XDMF: '/' and ':' become '_'.
std::string nameInPath(std::string name);

/// The name of a block's group: that of the material, or `material2` where it has none.
std::string groupName(const std::string& material, int materialIndex);

/// `t00042`.
std::string stepName(int step);
/// `t00042.h5`.
std::string outputName(int step);
/// The step of `t00042`, or none where a name is no stepName.
std::optional<int> stepOf(const std::string& name);

}  // namespace tushar::output
