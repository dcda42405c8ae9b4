#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "job/folder_lock.h"

namespace sonarsim {

/// The folder of an export. Files are written into DEST.part, which gets the name DEST once it is
/// whole. A hidden file, .sonarsim-export.json, identifies the datasets of the export.
class ExportDestination {
  public:
    /// `identity` stands for the datasets and options. InputError when DEST holds anything but this
    /// very export, when DEST.part holds anything but an unfinished export or another run writes
    /// there, and when DEST lies in one of the folders `sources`. An unfinished export is removed.
    ExportDestination(const std::filesystem::path& dest, const nlohmann::ordered_json& identity,
                      const std::vector<std::filesystem::path>& sources);
    /// Removes what was not committed.
    ~ExportDestination();
    ExportDestination(const ExportDestination&) = delete;
    ExportDestination& operator=(const ExportDestination&) = delete;

    /// True if DEST holds the export already; there is no part() then.
    bool is_there() const { return !lock_; }
    const std::filesystem::path& part() const { return part_; }
    /// Makes the files durable and renames the folder.
    void commit();

  private:
    std::filesystem::path dest_;
    std::filesystem::path part_;
    std::optional<FolderLock> lock_;
    bool committed_ = false;
};

}  // namespace sonarsim
