#include "run/job/journal.h"

#include <chrono>
#include <fstream>
#include <sstream>

#include "core/error.h"
#include "core/file.h"
#include "core/hash.h"
#include "output/dataset/layout.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t hash_digits = 8;

std::string with_checksum(const std::string& line) {
    return line + ' ' + fnv1a_128(line).substr(0, hash_digits) + '\n';
}

/// The line without its hash; empty if they do not agree.
std::string strip_checksum(const std::string& line) {
    const std::size_t blank = line.rfind(' ');
    if (blank == std::string::npos) return {};
    std::string text = line.substr(0, blank);
    return with_checksum(text) == line + '\n' ? text : "";
}

std::string ping_line(const PingId& ping, const std::string& fields) {
    return with_checksum("ping " + std::to_string(ping.sensor) + ' ' + std::to_string(ping.pose) +
                         ' ' + fields);
}

/// Reads line by line, since a part may be long.
void read_part(const fs::path& path, JournalEntries& entries) {
    std::ifstream lines(path, std::ios::binary);
    if (!lines) {
        // The run that completes a dataset removes the parts; journal.txt has all of them then.
        if (fs::exists(path)) throw InputError({path.string()}, "cannot be read");
        return;
    }
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(strip_checksum(line));
        std::string word;
        PingId ping;
        std::string fields;
        words >> word >> ping.sensor >> ping.pose >> std::ws;
        if (word == "ping" && std::getline(words, fields)) entries[ping] = fields;
    }
}

}  // namespace

JournalEntries read_journal(const fs::path& folder) {
    JournalEntries entries;
    // Parts first: the run that completes a dataset writes journal.txt before it removes them.
    for (const fs::path& part : journal_parts(folder))
        read_part(part, entries);
    if (fs::is_regular_file(folder / journal_name)) read_part(folder / journal_name, entries);
    return entries;
}

void write_journal(const fs::path& path, const JournalEntries& entries) {
    StreamedFile file(path);
    for (const auto& [ping, fields] : entries)
        file.append(ping_line(ping, fields));
    file.finish();
}

Journal::Journal(const ShardLock& lock, double checkpoint_seconds)
    : lock_(lock),
      // The last line of an interrupted run may be torn.
      pending_(::lseek(lock.fd(), 0, SEEK_END) > 0 ? "\n" : ""),
      checkpoints_(std::async(std::launch::async, [this, checkpoint_seconds] {
          make_checkpoints(checkpoint_seconds);
      })) {}

Journal::~Journal() {
    try {
        finish();
    } catch (...) {  // NOLINT(bugprone-empty-catch): the run ends for another reason already
    }
}

void Journal::add(const PingId& ping, const std::string& fields) {
    // The thread ends before finish() only where a checkpoint has failed.
    if (checkpoints_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
        checkpoints_.get();
    const std::lock_guard lock(mutex_);
    pending_ += ping_line(ping, fields);
}

void Journal::finish() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    wake_.notify_one();
    if (checkpoints_.valid()) checkpoints_.get();
}

void Journal::make_checkpoints(double seconds_between) {
    const std::chrono::duration<double> interval(seconds_between);
    for (bool ending = false; !ending;) {
        std::unique_lock lock(mutex_);
        wake_.wait_for(lock, interval, [this] { return ending_; });
        ending = ending_;
        const std::string lines = std::exchange(pending_, {});
        lock.unlock();
        if (!lines.empty()) append(lines);
    }
}

void Journal::append(std::string_view lines) const {
    sync_file_system(lock_.folder());
    const auto written = move_all(lines.size(), [&](std::size_t done) {
        return ::write(lock_.fd(), lines.data() + done, lines.size() - done);
    });
    if (!written || ::fdatasync(lock_.fd()) != 0) throw_errno("cannot write", lock_.part());
}

}  // namespace sonarsim
