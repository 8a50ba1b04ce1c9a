/// A disk that fails on demand, between a program and the C library: preloaded, it counts every operation
/// that changes something below the directories named, and fails from one of them on, or kills the process
/// there.
///
/// - FAULTS_BELOW: absolute directories, separated by colons; nothing elsewhere is counted or touched.
/// - FAULTS_COUNT: a file that gets one letter for each operation: w for a write, r for a removal, else c.
/// - FAULTS_KIND and FAULTS_AT, the number of an operation from 0:
///   - count: nothing fails.
///   - once: that operation fails with ENOSPC, those after it work.
///   - from: that operation and all after it fail, as on a disk that stays full.
///   - short: a write is cut in half there, and everything after it fails.
///   - kill: SIGKILL before that operation.
///   - term, int, hup: SIGTERM, SIGINT, SIGHUP before it.
///   - torn: SIGKILL after half of the write that it is.
///   - bytes: writes fail as soon as FAULTS_AT bytes have been written in all.
///   - read_only: every operation fails with EROFS.
///
/// Operations are: to open for writing, to write, to bring to the disk, to close a stream, to cut, to rename,
/// to make and remove files and folders. Removing does not fail for want of space, but a kill may come before
/// it. What the C library calls inside itself is not seen; hence streams (FILE) are counted as they are
/// called.
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

namespace {

template <typename Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

enum class Kind { count, once, from, cut, kill, term, interrupt, hang_up, torn, bytes, read_only };

struct Faults {
  std::string below;
  Kind kind = Kind::count;
  long at = -1;
  int count_file = -1;

  Faults() {
    const auto text = [](const char* name) {
      const char* value = std::getenv(name);
      return std::string(value == nullptr ? "" : value);
    };
    below = text("FAULTS_BELOW");
    const std::pair<const char*, Kind> kinds[] = {
        {"once", Kind::once},   {"from", Kind::from},     {"short", Kind::cut},          {"kill", Kind::kill},
        {"term", Kind::term},   {"int", Kind::interrupt}, {"hup", Kind::hang_up},        {"torn", Kind::torn},
        {"bytes", Kind::bytes}, {"count", Kind::count},   {"read_only", Kind::read_only}};
    for (const auto& [name, value] : kinds)
      if (text("FAULTS_KIND") == name) kind = value;
    if (const auto number = text("FAULTS_AT"); !number.empty()) at = std::atol(number.c_str());
    if (const auto file = text("FAULTS_COUNT"); !file.empty())
      count_file = next<int(const char*, int, ...)>("open")(file.c_str(),
                                                            O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  }
};

const Faults& faults() {
  static const Faults all;
  return all;
}

std::atomic<long> n_operations{0}, n_bytes{0};

/// A name below an open directory as that directory's name now and the rest.
std::string by_its_name(std::string_view path) {
  const std::string_view open_files = "/proc/self/fd/";
  if (path.substr(0, open_files.size()) != open_files) return std::string(path);
  const auto end = std::min(path.find('/', open_files.size()), path.size());
  char name[PATH_MAX];
  const auto size = readlink(std::string(path.substr(0, end)).c_str(), name, sizeof name);
  return (size > 0 ? std::string(name, std::size_t(size)) : "") + std::string(path.substr(end));
}

bool is_below(std::string_view as_given) {
  const std::string path = by_its_name(as_given);
  std::string_view rest = faults().below;
  while (!rest.empty()) {
    const auto one = rest.substr(0, rest.find(':'));
    if (path.compare(0, one.size(), one) == 0 && (path.size() == one.size() || path[one.size()] == '/'))
      return true;
    rest.remove_prefix(one.size() == rest.size() ? rest.size() : one.size() + 1);
  }
  return false;
}

bool is_below(int file) {
  char path[PATH_MAX];
  const auto size = readlink(("/proc/self/fd/" + std::to_string(file)).c_str(), path, sizeof path);
  return size > 0 && is_below(std::string_view(path, std::size_t(size)));
}

bool is_below(int directory, const char* path) {
  if (path[0] == '/') return is_below(std::string_view(path));
  char base[PATH_MAX];
  const auto link =
      directory == AT_FDCWD ? std::string("/proc/self/cwd") : "/proc/self/fd/" + std::to_string(directory);
  const auto size = readlink(link.c_str(), base, sizeof base);
  if (size <= 0) return false;
  // "." and "..", which a relative name may begin with, are of no account for names inside.
  std::string_view name = path;
  while (name.substr(0, 2) == "./") name.remove_prefix(2);
  return is_below(std::string(base, std::size_t(size)) + '/' + std::string(name));
}

enum class Operation { change, write, removal };
enum class Verdict { works, fails, half };

/// Counts an operation, and says what becomes of it; sets errno where it fails. May not return.
Verdict judge(Operation operation, std::size_t size = 0) {
  const auto& all = faults();
  const long number = n_operations++;
  if (all.count_file >= 0) {
    const char* const letter = operation == Operation::write     ? "w"
                               : operation == Operation::removal ? "r"
                                                                 : "c";
    next<ssize_t(int, const void*, std::size_t)>("write")(all.count_file, letter, 1);
  }
  const bool takes_space = operation != Operation::removal;
  const auto fail = [&] {
    errno = all.kind == Kind::read_only ? EROFS : ENOSPC;
    return Verdict::fails;
  };
  switch (all.kind) {
    case Kind::count:
      break;
    case Kind::once:
      if (number == all.at && takes_space) return fail();
      break;
    case Kind::from:
      if (number >= all.at && takes_space) return fail();
      break;
    case Kind::cut:
      if (number == all.at && operation == Operation::write) return Verdict::half;
      if (number >= all.at && takes_space) return fail();
      break;
    case Kind::kill:
      if (number == all.at) kill(getpid(), SIGKILL);
      break;
    case Kind::term:
      if (number == all.at) raise(SIGTERM);
      break;
    case Kind::interrupt:
      if (number == all.at) raise(SIGINT);
      break;
    case Kind::hang_up:
      if (number == all.at) raise(SIGHUP);
      break;
    case Kind::torn:
      if (number == all.at && operation == Operation::write) return Verdict::half;
      if (number >= all.at) kill(getpid(), SIGKILL);
      break;
    case Kind::bytes:
      if (operation == Operation::write && (n_bytes += long(size)) > all.at) return fail();
      break;
    case Kind::read_only:
      return fail();
  }
  return Verdict::works;
}

void after_half() {
  if (faults().kind == Kind::torn) kill(getpid(), SIGKILL);
}

bool opens_for_writing(int flags) {
  return (flags & O_ACCMODE) != O_RDONLY || (flags & (O_CREAT | O_TRUNC)) != 0;
}

bool opens_for_writing(const char* mode) {
  return std::strpbrk(mode, "wa+") != nullptr;
}

}  // namespace

// The C library names its parameters as users may not.
// NOLINTBEGIN(readability-inconsistent-declaration-parameter-name)
extern "C" {

#define OPEN(name)                                                                                          \
  int name(const char* path, int flags, ...) {                                                              \
    va_list more;                                                                                           \
    va_start(more, flags);                                                                                  \
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;                    \
    va_end(more);                                                                                           \
    if (opens_for_writing(flags) && is_below(AT_FDCWD, path) && judge(Operation::change) != Verdict::works) \
      return -1;                                                                                            \
    return next<int(const char*, int, ...)>(#name)(path, flags, mode);                                      \
  }
OPEN(open)
OPEN(open64)

#define OPENAT(name)                                                                                         \
  int name(int directory, const char* path, int flags, ...) {                                                \
    va_list more;                                                                                            \
    va_start(more, flags);                                                                                   \
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;                     \
    va_end(more);                                                                                            \
    if (opens_for_writing(flags) && is_below(directory, path) && judge(Operation::change) != Verdict::works) \
      return -1;                                                                                             \
    return next<int(int, const char*, int, ...)>(#name)(directory, path, flags, mode);                       \
  }
OPENAT(openat)
OPENAT(openat64)

#define FOPEN(name)                                                                                        \
  FILE* name(const char* path, const char* mode) {                                                         \
    if (opens_for_writing(mode) && is_below(AT_FDCWD, path) && judge(Operation::change) != Verdict::works) \
      return nullptr;                                                                                      \
    return next<FILE*(const char*, const char*)>(#name)(path, mode);                                       \
  }
FOPEN(fopen)
FOPEN(fopen64)

ssize_t write(int file, const void* data, size_t size) {
  const auto real = next<ssize_t(int, const void*, size_t)>("write");
  if (!is_below(file)) return real(file, data, size);
  const auto verdict = judge(Operation::write, size);
  if (verdict == Verdict::fails) return -1;
  const auto written = real(file, data, verdict == Verdict::half ? size / 2 : size);
  if (verdict == Verdict::half) after_half();
  return written;
}

#define PWRITE(name)                                                                       \
  ssize_t name(int file, const void* data, size_t size, off_t at) {                        \
    const auto real = next<ssize_t(int, const void*, size_t, off_t)>(#name);               \
    if (!is_below(file)) return real(file, data, size, at);                                \
    const auto verdict = judge(Operation::write, size);                                    \
    if (verdict == Verdict::fails) return -1;                                              \
    const auto written = real(file, data, verdict == Verdict::half ? size / 2 : size, at); \
    if (verdict == Verdict::half) after_half();                                            \
    return written;                                                                        \
  }
PWRITE(pwrite)
PWRITE(pwrite64)

ssize_t writev(int file, const iovec* parts, int n_parts) {
  const auto real = next<ssize_t(int, const iovec*, int)>("writev");
  if (!is_below(file)) return real(file, parts, n_parts);
  size_t size = 0;
  for (int i = 0; i < n_parts; ++i) size += parts[i].iov_len;
  const auto verdict = judge(Operation::write, size);
  if (verdict == Verdict::fails) return -1;
  const auto written = real(file, parts, verdict == Verdict::half ? n_parts / 2 : n_parts);
  if (verdict == Verdict::half) after_half();
  return written;
}

size_t fwrite(const void* data, size_t size, size_t n, FILE* file) {
  const auto real = next<size_t(const void*, size_t, size_t, FILE*)>("fwrite");
  if (!is_below(fileno(file))) return real(data, size, n, file);
  const auto verdict = judge(Operation::write, size * n);
  if (verdict == Verdict::fails) return 0;
  const auto written = real(data, size, verdict == Verdict::half ? n / 2 : n, file);
  if (verdict == Verdict::half) after_half();
  return written;
}

int fclose(FILE* file) {
  const bool writes = (fcntl(fileno(file), F_GETFL) & O_ACCMODE) != O_RDONLY;
  const bool fails = writes && is_below(fileno(file)) && judge(Operation::change) != Verdict::works;
  const int closed = next<int(FILE*)>("fclose")(file);
  if (fails) errno = ENOSPC;
  return fails ? EOF : closed;
}

int fsync(int file) {
  if (is_below(file) && judge(Operation::change) != Verdict::works) return -1;
  return next<int(int)>("fsync")(file);
}

#define TRUNCATE(name)                                                           \
  int name(int file, off_t size) {                                               \
    if (is_below(file) && judge(Operation::change) != Verdict::works) return -1; \
    return next<int(int, off_t)>(#name)(file, size);                             \
  }
TRUNCATE(ftruncate)
TRUNCATE(ftruncate64)

int rename(const char* from, const char* to) noexcept {
  if (is_below(AT_FDCWD, to) && judge(Operation::change) != Verdict::works) return -1;
  return next<int(const char*, const char*)>("rename")(from, to);
}

int renameat(int from_directory, const char* from, int to_directory, const char* to) noexcept {
  if (is_below(to_directory, to) && judge(Operation::change) != Verdict::works) return -1;
  return next<int(int, const char*, int, const char*)>("renameat")(from_directory, from, to_directory, to);
}

int mkdirat(int directory, const char* path, mode_t mode) noexcept {
  if (is_below(directory, path) && judge(Operation::change) != Verdict::works) return -1;
  return next<int(int, const char*, mode_t)>("mkdirat")(directory, path, mode);
}

int mkdir(const char* path, mode_t mode) noexcept {
  if (is_below(AT_FDCWD, path) && judge(Operation::change) != Verdict::works) return -1;
  return next<int(const char*, mode_t)>("mkdir")(path, mode);
}

#define REMOVE(name)                                                                        \
  int name(const char* path) noexcept {                                                     \
    if (is_below(AT_FDCWD, path) && judge(Operation::removal) != Verdict::works) return -1; \
    return next<int(const char*)>(#name)(path);                                             \
  }
REMOVE(remove)
REMOVE(unlink)
REMOVE(rmdir)

int unlinkat(int directory, const char* path, int flags) noexcept {
  if (is_below(directory, path) && judge(Operation::removal) != Verdict::works) return -1;
  return next<int(int, const char*, int)>("unlinkat")(directory, path, flags);
}

}  // extern "C"
// NOLINTEND(readability-inconsistent-declaration-parameter-name)
