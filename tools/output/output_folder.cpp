#include "tools/output/output_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iterator>
#include <string_view>
#include <thread>

#include "tools/output/link_out.hpp"
#include "tools/output/output_error.hpp"
#include "tools/output/summary.hpp"

namespace puffin::output {
namespace {

namespace fs = std::filesystem;

/// Everything a run writes at the top of its folder; nothing else is ever removed.
/// status.json, by which the folder is known for a run's, goes last: who is killed meanwhile leaves a run's folder.
constexpr std::array<std::string_view, 19> own_names{
    "case.toml",   "log.txt",    "summary.json", "summary.csv",      "index.html", "history.csv", "stats.h5",
    "events.h5",   "probes.csv", "lines.csv",    "planes.csv",       "forces.csv", "tracks.csv",  "vtk",
    "checkpoints", "images",     "report.html",  "micromodels.toml", "status.json"};

[[noreturn]] void fail(const fs::path& where, const std::string& what, int error) {
  const bool vanished = error == ENOENT && !fs::exists(where.parent_path());
  throw OutputError("cannot " + what + " " + where.string() + ": " + std::strerror(error) +
                    (vanished ? "; its folder has vanished"
                              : "; free some space, or choose a folder that can be written with --out"));
}

std::string timestamp() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char text[32];
  std::strftime(text, sizeof text, "%Y%m%d-%H%M%S", &local);
  return text;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)  // not fail(): a missing parent would have been made
    throw OutputError("cannot create the folder " + folder.string() + ": " + error.message() +
                      "; choose another place with --out");
  if (access(folder.c_str(), W_OK) != 0) fail(folder, "write into", errno);
}

constexpr std::string_view checkpoint_prefix = "checkpoint-", checkpoint_suffix = ".bin";

/// A new folder below runs/NAME, also when two runs start within the same second.
fs::path fresh_folder(const fs::path& parent) {
  make_folder(parent);
  const std::string stamp = timestamp();
  for (int attempt = 1; attempt < 1000; ++attempt) {
    const fs::path folder = parent / (attempt == 1 ? stamp : stamp + "-" + std::to_string(attempt));
    std::error_code error;
    if (fs::create_directory(folder, error)) return folder;
    if (error)  // not fail(): a missing parent would have been made
      throw OutputError("cannot create the folder " + folder.string() + ": " + error.message() +
                        "; choose another place with --out");
  }
  throw OutputError(parent.string() + " holds a thousand runs of this second; choose a folder with --out");
}

/// runs/NAME/latest -> TIMESTAMP, replaced in one move.
void point_latest(const fs::path& folder) {
  const fs::path link = folder.parent_path() / "latest";
  const fs::path temporary = folder.parent_path() / (".latest-" + std::to_string(getpid()));
  std::error_code error;
  fs::remove(temporary, error);
  fs::create_directory_symlink(folder.filename(), temporary, error);
  if (!error) fs::rename(temporary, link, error);
  if (error) fail(link, "set the link", error.value());
}

/// True if the folder holds a run to go on with.
bool refuse_or_clear(const fs::path& folder, bool resume) {
  const std::string where = folder.string();
  if (fs::exists(folder / "study.json")) throw OutputError(where + " holds a study; choose another folder with --out");
  const bool from_a_run = fs::exists(folder / "status.json");
  const bool has_checkpoints = from_a_run && !list_checkpoints(folder).empty();
  if (fs::exists(folder / "summary.json")) {
    const Summary summary = read_summary(folder / "summary.json");
    const bool goes_on = summary.until.has_value() && has_checkpoints;  // ended by --until, before its stop time
    if (summary.state == "finished" && !(resume && goes_on))
      throw OutputError(where + " holds a finished run, which is never overwritten; choose another folder with --out" +
                        (goes_on ? ", or go on beyond its --until with --resume" : ""));
  }
  if (resume && has_checkpoints) return true;
  if (resume && !from_a_run) throw OutputError(where + " holds no run to resume; start it without --resume");
  if (has_checkpoints) {
    throw OutputError(where +
                      " holds an unfinished run with checkpoints; add --resume to go on with it, or choose another "
                      "folder with --out");
  }
  for (const std::string_view name : own_names) {
    const fs::path file = folder / name;
    if (!fs::exists(fs::symlink_status(file))) continue;
    if (!from_a_run) {
      throw OutputError(file.string() + " exists but " + where +
                        " is not the folder of a run; choose an empty folder with --out");
    }
    std::error_code error;
    fs::remove_all(file, error);
    if (error) fail(file, "remove", error.value());
  }
  return false;
}

}  // namespace

fs::path checkpoint_name(std::int64_t number) {
  std::string digits = std::to_string(number);
  digits.insert(0, digits.size() < 6 ? 6 - digits.size() : 0, '0');
  return fs::path("checkpoints") / (std::string(checkpoint_prefix) + digits + std::string(checkpoint_suffix));
}

std::int64_t checkpoint_number(const fs::path& file) {
  const std::string name = file.filename().string();
  if (!name.starts_with(checkpoint_prefix) || !name.ends_with(checkpoint_suffix)) return -1;
  std::int64_t number = -1;
  const char* begin = name.data() + checkpoint_prefix.size();
  const char* end = name.data() + name.size() - checkpoint_suffix.size();
  const auto [stop, error] = std::from_chars(begin, end, number);
  return error == std::errc() && stop == end ? number : -1;
}

std::vector<fs::path> list_checkpoints(const fs::path& run) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator at(run / "checkpoints", error), end; !error && at != end; at.increment(error))
    if (checkpoint_number(at->path()) >= 0) files.push_back(at->path());
  std::sort(files.begin(), files.end(),
            [](const fs::path& a, const fs::path& b) { return checkpoint_number(a) > checkpoint_number(b); });
  return files;
}

std::string folder_name(const std::string& name) {
  std::string out;
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                       c == '_' || (c == '.' && !out.empty());
    out += plain ? c : '_';
  }
  return out.empty() ? "run" : out;
}

OutputFolder::OutputFolder(const std::optional<fs::path>& out, const std::string& name, bool resume) {
  if (out) {
    if (std::error_code error; resume && !fs::exists(*out, error))
      throw OutputError(fs::absolute(*out).string() + " holds no run to resume; start it without --resume");
    const fs::path plain = fs::absolute(*out).lexically_normal();  // a/../b makes no a
    make_folder(plain);
    path_ = fs::canonical(plain);
    hold(resume);
    resumed_ = refuse_or_clear(path_, resume);
    return;
  }
  const fs::path parent = fs::absolute(fs::path("runs") / folder_name(name));
  if (resume) {
    std::error_code error;
    path_ = fs::canonical(parent / "latest", error);
    if (error) throw OutputError(parent.string() + " holds no run to resume; name its folder with --out");
    hold(true);
    resumed_ = refuse_or_clear(path_, true);
    return;
  }
  path_ = fs::canonical(fresh_folder(parent));
  hold(false);
  point_latest(path_);
}

/// Two processes in one folder would write over each other. Leaves nothing behind.
void OutputFolder::hold(bool patient) {
  const int descriptor = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  lock_ = std::shared_ptr<const int>(new int(descriptor), [](const int* d) {
    close(*d);
    delete d;
  });
  constexpr auto pause = std::chrono::milliseconds(100);
  for (int tries = patient ? 200 : 1; flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;) {
    if (--tries == 0)
      throw OutputError("another run is at work in " + path_.string() + "; wait for it, or choose another with --out");
    std::this_thread::sleep_for(pause);
  }
}

fs::path OutputFolder::file(const fs::path& relative) const {
  const fs::path inside = relative.lexically_normal();
  if (relative.empty() || relative.is_absolute() || inside.empty() || *inside.begin() == "..") {
    throw OutputError("refused to write " + relative.string() + ": it lies outside the run's folder " + path_.string() +
                      "; use a plain name");
  }
  if (std::error_code error; !fs::is_directory(path_, error))
    throw OutputError("the run's folder " + path_.string() +
                      " has vanished; what the run wrote since is lost, so it ends here");
  fs::path full = path_ / inside;
  make_folder(full.parent_path());
  refuse_link_out(path_, full);
  return full;
}

void OutputFolder::write_text(const fs::path& relative, const std::string& text) const {
  write_whole(file(relative), text);
}

namespace {

void write_and_rename(const fs::path& file, const std::string& text, bool sync) {
  const fs::path temporary = file.string() + ".part";
  unlink(temporary.c_str());  // what a killed program left; or a link, which is not followed
  const int descriptor = open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (descriptor < 0) fail(file, "write", errno);
  std::size_t done = 0;
  int error = 0;
  while (done < text.size() && error == 0) {
    const ssize_t count = write(descriptor, text.data() + done, text.size() - done);
    if (count >= 0) {
      done += static_cast<std::size_t>(count);
    } else if (errno != EINTR) {
      error = errno;
    }
  }
  if (error == 0 && sync && fsync(descriptor) != 0 && errno != EINVAL) error = errno;
  if (close(descriptor) != 0 && error == 0) error = errno;
  if (error == 0 && std::rename(temporary.c_str(), file.c_str()) != 0) error = errno;
  if (error != 0) {
    unlink(temporary.c_str());
    fail(file, "write", error);
  }
}

}  // namespace

void write_whole(const fs::path& file, const std::string& text) { write_and_rename(file, text, true); }

void replace_whole(const fs::path& file, const std::string& text) { write_and_rename(file, text, false); }

std::string read_whole(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void keep_first(const fs::path& file, std::uint64_t bytes) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) fail(file, "read", error.value());
  if (size < bytes) {
    throw OutputError(file.string() + " is shorter than its checkpoint says (" + std::to_string(size) + " of " +
                      std::to_string(bytes) + " bytes), so the run cannot be resumed; start it anew");
  }
  fs::resize_file(file, bytes, error);
  if (error) fail(file, "write", error.value());
}

void sync_file(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail(file, "write", errno);
  const int error = fsync(descriptor) != 0 && errno != EINVAL ? errno : 0;
  close(descriptor);
  if (error != 0) fail(file, "write", error);
}

void finish_file(const fs::path& temporary, const fs::path& file) {
  sync_file(temporary);
  if (std::rename(temporary.c_str(), file.c_str()) != 0) fail(file, "write", errno);
}

}  // namespace puffin::output
