#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <functional>

#include "meshes/shaft/shaft.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/files/content_hash.h"
#include "pipelines/base/files/hdf5_file.h"
#include "pipelines/base/files/kept_file.h"
#include "pipelines/base/files/replaceable.h"
#include "pipelines/write/exports/vtk_files.h"
#include "pipelines/write/files/results.h"
#include "tests/unit/pipelines/examples/results_bar.h"
#include "tests/unit/pipelines/examples/results_directory.h"

using namespace pipelines;
using results_test::bytes;
using results_test::Directory;
namespace fs = std::filesystem;

namespace {

std::string refusal_to_write(const fs::path& file) {
  try {
    write_text_file(file, "new");
    return "";
  } catch (const OptionError& error) {
    return error.what();
  }
}

std::size_t n_files_in(const fs::path& directory) {
  return std::size_t(std::distance(fs::directory_iterator(directory), {}));
}

TEST(Replaceable, LinksPipesDevicesAndFoldersStay) {
  const Directory at;
  std::ofstream(at / "own") << "mine";
  fs::create_symlink(at / "own", at / "link");
  fs::create_symlink(at / "nothing", at / "broken_link");
  ASSERT_EQ(mkfifo((at / "pipe").c_str(), 0600), 0);
  fs::create_directory(at / "folder");
  const auto n_before = n_files_in(at.path);
  EXPECT_NE(refusal_to_write(at / "link").find("link: is a symbolic link"), std::string::npos);
  EXPECT_NE(refusal_to_write(at / "broken_link").find("is a symbolic link"), std::string::npos);
  EXPECT_NE(refusal_to_write(at / "pipe").find("pipe: is a pipe"), std::string::npos);
  EXPECT_NE(refusal_to_write(at / "folder").find("is a directory"), std::string::npos);
  EXPECT_NE(why_not_replaceable("/dev/null").find("is a device"), std::string::npos);
  EXPECT_EQ(why_not_replaceable(at / "own"), "");
  EXPECT_EQ(why_not_replaceable(at / "new"), "");
  EXPECT_TRUE(fs::is_symlink(at / "link"));
  EXPECT_TRUE(fs::is_fifo(at / "pipe"));
  EXPECT_EQ(bytes(at / "own"), "mine");
  EXPECT_EQ(n_files_in(at.path), n_before);
}

TEST(Replaceable, AnInputStaysUnderEveryNameItHas) {
  const Directory at;
  std::ofstream(at / "loads.csv") << "measured";
  fs::create_hard_link(at / "loads.csv", at / "second_name.csv");
  note_input(at / "loads.csv");
  for (const auto& file : {at / "loads.csv", at / "second_name.csv", at.path / "." / "loads.csv"}) {
    EXPECT_NE(refusal_to_write(file).find("is an input of this run"), std::string::npos) << file;
    EXPECT_EQ(bytes(file), "measured");
  }
  EXPECT_EQ(refusal_to_write(at / "other.csv"), "");
  try {
    require_replaceable(at / "loads.csv", "--csv");
    FAIL();
  } catch (const OptionError& error) {
    EXPECT_EQ(std::string(error.what()), "--csv " + (at / "loads.csv").string() +
                                             ": is an input of this run, and is not replaced; give --csv a "
                                             "new name, or move it away");
  }
}

// A run whose input changes while it computes has results of neither. A pipe is not read for its hash: what
// was taken from it would be missing later.
TEST(Replaceable, InputsAreNotedWithTheirContent) {
  const Directory at;
  std::ofstream(at / "a.csv") << "1";
  ASSERT_EQ(mkfifo((at / "pipe").c_str(), 0600), 0);
  const auto n_before = noted_inputs().size();
  for (const char* name : {"a.csv", "a.csv", "pipe", "missing"}) note_input(at / name);
  const auto noted = noted_inputs();
  ASSERT_EQ(noted.size(), n_before + 3);
  const auto input = noted[n_before];
  EXPECT_EQ(input.file, at / "a.csv");
  EXPECT_EQ(input.hash, text_hash("1"));
  EXPECT_EQ(noted[n_before + 1].hash, "");
  EXPECT_EQ(noted[n_before + 2].hash, "");
  EXPECT_TRUE(are_as_noted({input}));
  EXPECT_FALSE(are_as_noted({input, noted[n_before + 2]}));
  std::ofstream(at / "a.csv") << "2";
  EXPECT_FALSE(are_as_noted({input}));
  fs::remove(at / "a.csv");
  EXPECT_FALSE(are_as_noted({input}));
}

TEST(AtomicFile, RefusesAFileWithoutItsEnd) {
  const Directory at;
  write_text_file(at / "e.vtu", "old");
  AtomicFile file(at / "e.vtu");
  std::ofstream(file.temporary()) << "<VTKFile>...";
  EXPECT_THROW(file.commit("</VTKFile>\n"), FileError);
  EXPECT_EQ(bytes(at / "e.vtu"), "old");
}

/// How a write ends in a process whose files may have so many bytes: a disk that is full there.
/// @return 0: done; 1: refused as a file that cannot be written; 2: any other way
int end_of_write(std::size_t most_bytes, const std::function<void()>& write) {
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{most_bytes, most_bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      write();
    } catch (const FileError&) {
      _exit(1);
    } catch (...) {
      _exit(2);
    }
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 2;
}

// Whatever the disk does not take is an error that is told, and the earlier file stays.
TEST(FullDisk, IsToldByEveryKindOfFile) {
  const Directory at;
  const auto nodes = results_test::mapped_cube(3, 3, 3, results_test::quadratic_map);
  const std::vector<double> field(nodes.n, 1.25);
  meshes::Shaft shaft;
  shaft.segments = {{"rod", 0, 0.05, 0.05, 0, true}};
  const auto rod = meshes::build_shaft(shaft, {});
  const std::vector<std::pair<std::string, std::function<void(const fs::path&)>>> kinds{
      {"text", [&](const fs::path& file) { write_text_file(file, std::string(30000, 'x')); }},
      {"vtu",
       [&](const fs::path& file) {
         write_envelope_vtu(file, nodes, {nodal_field("f", field)}, {}, VtuCompression::none);
       }},
      {"surface vtu",
       [&](const fs::path& file) { write_surface_snapshot_vtu(file, nodes, {nodal_field("f", field)}); }},
      {"mesh", [&](const fs::path& file) { write_mesh(file, rod); }},
      {"kept HDF5", [&](const fs::path& file) {
         AtomicFile atomic(file);
         Hdf5Writer out(atomic.temporary());
         out.write("/values", std::vector<double>(4000, 1.5));
         out.close();
         append_checksum(atomic.temporary(), "key");
         atomic.commit();
       }}};
  for (const auto& known : kinds) {
    const std::string& kind = known.first;
    const auto& write = known.second;  // a lambda does not capture structured bindings
    const auto file = at / "file";
    write(file);
    const auto size = fs::file_size(file);
    const auto whole = bytes(file);
    write_text_file(file, "old");
    for (std::size_t tenth = 0; tenth < 10; ++tenth) {
      EXPECT_EQ(end_of_write(size * tenth / 10, [&] { write(file); }), 1) << kind << ' ' << tenth;
      EXPECT_EQ(bytes(file), "old") << kind << ' ' << tenth;
    }
    EXPECT_EQ(end_of_write(size - 1, [&] { write(file); }), 1) << kind;
    EXPECT_EQ(bytes(file), "old") << kind;
    EXPECT_EQ(end_of_write(size, [&] { write(file); }), 0) << kind;
    EXPECT_TRUE(bytes(file) == whole) << kind;
    EXPECT_EQ(n_files_in(at.path), 1u) << kind;
  }
}

}  // namespace
