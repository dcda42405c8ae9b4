#include "job/journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <system_error>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/file.h"
#include "core/hash.h"
#include "core/text.h"
#include "dataset/layout.h"
#include "job/folder_lock.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t hash_digits = 8;

/// The line with its hash and line feed.
std::string sealed(const std::string& line) {
    return line + ' ' + fnv1a_128(line).substr(0, hash_digits) + '\n';
}

/// The line without its hash; nothing if they do not agree.
std::optional<std::string> opened(const std::string& line) {
    const std::size_t space = line.rfind(' ');
    if (space == std::string::npos) return std::nullopt;
    std::string text = line.substr(0, space);
    if (fnv1a_128(text).substr(0, hash_digits) != line.substr(space + 1)) return std::nullopt;
    return text;
}

std::string ping_line(const PingId& ping, const std::vector<std::string>& fields) {
    std::string line = "ping " + std::to_string(ping.sensor) + ' ' + std::to_string(ping.pose);
    for (const std::string& field : fields)
        line += ' ' + field;
    return sealed(line);
}

void read_line(const std::string& line, JournalEntries& entries) {
    const std::optional<std::string> text = opened(line);
    if (!text) return;
    std::istringstream words(*text);
    std::string word;
    std::uint32_t sensor = 0;
    words >> word >> sensor;
    if (word == "ping") {
        PingId ping{0, sensor};
        words >> ping.pose;
        std::vector<std::string> fields;
        while (words >> word)
            fields.push_back(word);
        entries.pings.add(ping, fields);
    } else if (word == "product") {
        std::uint64_t size = 0;
        words >> word >> size;
        entries.products[{sensor, word}] = size;
    }
}

/// A line with the time of an event.
std::string time_line(const char* what, double seconds) {
    constexpr double milli = 1e3;
    return sealed(std::string(what) + ' ' + number_text(std::round(seconds * milli) / milli));
}

/// Reads line by line, since a part may be long.
void read_part(const fs::path& path, JournalEntries& entries) {
    std::ifstream lines(path, std::ios::binary);
    if (!lines) {
        // The run that completes a dataset removes the parts; journal.txt has all of them then.
        if (fs::exists(path)) throw InputError({path.string()}, "cannot be read");
        return;
    }
    for (std::string line; std::getline(lines, line);)
        read_line(line, entries);
}

}  // namespace

double seconds_since_1970() {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch())
        .count();
}

JournalEntries read_journal(const fs::path& folder) {
    JournalEntries entries;
    // Parts first: the run that completes a dataset writes journal.txt before it removes them.
    for (const fs::path& part : journal_parts(folder))
        read_part(part, entries);
    if (fs::is_regular_file(folder / journal_name)) read_part(folder / journal_name, entries);
    entries.pings.sort();
    return entries;
}

JournalRun read_journal_run(const fs::path& part) {
    JournalRun run;
    // Opening fails if the run that completed the dataset has removed the part.
    std::ifstream lines(part, std::ios::binary);
    for (std::string line; std::getline(lines, line);) {
        const std::optional<std::string> text = opened(line);
        if (!text) continue;
        std::istringstream words(*text);
        std::string word;
        std::string value;
        words >> word >> value;
        const double seconds = parse_number(value).value_or(0.0);
        if (word == "run") run = {0, seconds, seconds};
        if (word == "checkpoint") run.last_s = seconds;
        run.pings += word == "ping";
    }
    return run;
}

void write_journal(const fs::path& path, const JournalEntries& entries) {
    StreamedFile file(path);
    entries.pings.for_each([&](const PingId& ping, const std::vector<std::string>& fields) {
        file.append(ping_line(ping, fields));
    });
    for (const auto& [product, size] : entries.products) {
        file.append(sealed("product " + std::to_string(product.first) + ' ' + product.second + ' ' +
                           std::to_string(size)));
    }
    file.finish();
}

Journal::Journal(const fs::path& folder, const std::string& name, double checkpoint_seconds)
    : folder_(folder),
      path_(folder / journal_folder_name / name),
      fd_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0666)),
      start_s_(seconds_since_1970()) {
    if (fd_ < 0) throw_errno("cannot write", path_);
    if (!lock_file(fd_, lock_works_)) {
        ::close(fd_);
        refuse_second_run(folder_);
    }
    // The last line of an interrupted run may be torn.
    if (::lseek(fd_, 0, SEEK_END) > 0) pending_ = "\n";
    thread_ = std::thread([this, checkpoint_seconds] { run(checkpoint_seconds); });
}

Journal::~Journal() {
    try {
        finish();
    } catch (...) {  // NOLINT(bugprone-empty-catch): the run ends for another reason already
    }
    if (fd_ >= 0) ::close(fd_);
}

void Journal::add(const PingId& ping, const std::vector<std::string>& fields) {
    const std::lock_guard lock(mutex_);
    rethrow();
    pending_ += ping_line(ping, fields);
}

void Journal::finish() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    wake_.notify_one();
    if (thread_.joinable()) thread_.join();
    rethrow();
    if (fd_ >= 0 && ::close(std::exchange(fd_, -1)) != 0) throw_errno("cannot write", path_);
}

void Journal::run(double checkpoint_seconds) {
    const std::chrono::duration<double> interval(checkpoint_seconds);
    bool ending = false;
    while (!ending) {
        {
            std::unique_lock lock(mutex_);
            wake_.wait_for(lock, interval, [this] { return ending_; });
            ending = ending_;
        }
        try {
            checkpoint();
        } catch (...) {
            const std::lock_guard lock(mutex_);
            error_ = std::current_exception();
            return;
        }
    }
}

void Journal::checkpoint() {
    std::string lines;
    {
        const std::lock_guard lock(mutex_);
        lines.swap(pending_);
    }
    if (lines.empty()) return;
    sync_file_system(folder_);
    if (start_s_ > 0.0) {
        // A leading line feed ends the torn line of an interrupted run.
        const std::size_t begin = lines.front() == '\n' ? 1 : 0;
        lines.insert(begin, time_line("run", std::exchange(start_s_, 0.0)));
    }
    lines += time_line("checkpoint", seconds_since_1970());
    for (std::string_view rest = lines; !rest.empty();) {
        const ssize_t put = ::write(fd_, rest.data(), rest.size());
        if (put < 0 && errno == EINTR) continue;
        if (put < 0) throw_errno("cannot write", path_);
        rest.remove_prefix(static_cast<std::size_t>(put));
    }
    if (::fdatasync(fd_) != 0) throw_errno("cannot write", path_);
}

void Journal::rethrow() {
    if (error_) std::rethrow_exception(error_);
}

}  // namespace sonarsim
