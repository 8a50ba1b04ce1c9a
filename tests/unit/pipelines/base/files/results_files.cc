#include <gtest/gtest.h>
#include <hdf5.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <thread>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include "pipelines/base/disk/staging.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/files/csv.h"
#include "pipelines/base/files/hdf5_file.h"
#include "tests/unit/pipelines/examples/results_directory.h"

using namespace pipelines;
using results_test::bytes;
using results_test::Directory;

namespace {

std::size_t n_entries(const std::filesystem::path& directory) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(directory), {}));
}

TEST(AtomicFile, KeepsTheOldContentUntilCommit) {
  const Directory at;
  write_text_file(at / "sub/summary.json", "old");
  {
    AtomicFile file(at / "sub/summary.json");
    std::ofstream(file.temporary()) << "half";
    EXPECT_EQ(bytes(at / "sub/summary.json"), "old");
  }
  EXPECT_EQ(bytes(at / "sub/summary.json"), "old");
  EXPECT_EQ(n_entries(at / "sub"), 1U);
  try {
    AtomicFile file(at / "sub/summary.json");
    std::ofstream(file.temporary()) << "half";
    throw std::runtime_error("the stage failed");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(bytes(at / "sub/summary.json"), "old");
  EXPECT_EQ(n_entries(at / "sub"), 1U);
  AtomicFile file(at / "sub/summary.json");
  std::ofstream(file.temporary()) << "new";
  file.commit();
  EXPECT_EQ(bytes(at / "sub/summary.json"), "new");
}

TEST(AtomicFile, AKilledProcessHarmsNothingAndTheNextWriteCleansUp) {
  const Directory at;
  write_text_file(at / "envelope.vtu", "old");
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    AtomicFile file(at / "envelope.vtu");
    std::ofstream(file.temporary()) << "half" << std::flush;
    raise(SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(bytes(at / "envelope.vtu"), "old");
  EXPECT_EQ(n_entries(at.path), 2U);
  const AtomicFile of_a_living_process(at / "envelope.vtu");
  std::ofstream(of_a_living_process.temporary()) << "half";
  write_text_file(at / "envelope.vtu", "new");
  EXPECT_EQ(bytes(at / "envelope.vtu"), "new");
  EXPECT_EQ(n_entries(at.path), 2U);  // the file, and the one still being written
}

// Whatever the killed process was writing goes, whole folders too; what a living one writes stays, and so
// does what only looks alike.
TEST(AtomicFile, WhatKilledProcessesLeftIsRemovedWhateverTheTarget) {
  const Directory at;
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    AtomicFile a(at / "a.vtu"), b(at / "b.c.h5");
    for (auto* file : {&a, &b}) std::ofstream(file->temporary()) << "half" << std::flush;
    const DirectoryLock lock(OpenDirectory::at(at.path));
    raise(SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_EQ(n_entries(at.path), 3U);
  const AtomicFile of_a_living_process(at / "c.vtu");
  std::ofstream(of_a_living_process.temporary()) << "half";
  EXPECT_EQ(n_entries(at.path), 1U) << "the living one has removed what the killed one left";
  for (const char* name :
       {".partial", ".a.vtu.partial", ".millstress-0123456789abcdef.partial.csv", "zones.csv"})
    std::ofstream(at / name) << "mine";
  std::filesystem::create_directories(at / "elsewhere/inside");
  std::filesystem::create_symlink("elsewhere", at / ".millstress-0123456789abcdef.partial");
  remove_abandoned(OpenDirectory::at(at.path));
  EXPECT_EQ(n_entries(at.path), 7U);
  EXPECT_TRUE(std::filesystem::exists(at / "elsewhere/inside"));
  EXPECT_TRUE(std::filesystem::exists(of_a_living_process.temporary()));
}

// A name that somebody has laid out before leads nowhere: the folder is new, and its user's alone.
TEST(AtomicFile, IsWrittenInAFolderOfItsOwn) {
  const Directory at;
  const AtomicFile one(at / "a.vtu"), other(at / "a.vtu");
  EXPECT_NE(std::filesystem::canonical(one.temporary().parent_path()),
            std::filesystem::canonical(other.temporary().parent_path()));
  for (const auto& entry : std::filesystem::directory_iterator(at.path))
    EXPECT_EQ(entry.status().permissions(), std::filesystem::perms::owner_all) << entry.path();
  std::filesystem::create_symlink(at / "elsewhere", at / ".millstress.lock");
  EXPECT_THROW(AtomicFile(at / "b.vtu"), std::filesystem::filesystem_error);
  EXPECT_FALSE(std::filesystem::exists(at / "elsewhere"));
}

// The lock's file is gone with its last holder; meanwhile everybody has the same.
TEST(DirectoryLock, IsHeldByOneAndLeavesNothing) {
  const Directory at;
  const auto directory = OpenDirectory::at(at.path);
  int n_inside = 0, most = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 50; ++i) {
        const DirectoryLock lock(directory);
        most = std::max(most, ++n_inside);
        std::this_thread::yield();
        --n_inside;
      }
    });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(most, 1);
  EXPECT_EQ(n_entries(at.path), 0U);
}

TEST(AtomicFile, NamesTheFileThatCannotBeWritten) {
  const Directory at;
  std::filesystem::create_directories(at / "taken/inside");
  EXPECT_THROW(write_text_file(at / "taken", "text"), std::exception);
  EXPECT_EQ(n_entries(at.path), 1U);
}

TEST(Csv, NumbersReadBackToTheSameDouble) {
  const Directory at;
  const std::vector<double> values = {0.1, 1. / 3, -0., 1e300, 5e-324, 123456789.123456789, 3};
  write_csv(at / "torque.csv", {{"torque", "N m", values}});
  std::ifstream text(at / "torque.csv");
  std::string line;
  std::getline(text, line);
  EXPECT_EQ(line, "torque [N m]");
  for (const double value : values) {
    std::getline(text, line);
    const double read = std::strtod(line.c_str(), nullptr);
    EXPECT_EQ(read, value);
    EXPECT_EQ(std::signbit(read), std::signbit(value));
  }
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(std::nan("")), "nan");
}

TEST(Csv, QuotesWhatNeedsItAndRefusesRaggedColumns) {
  const std::vector<CsvColumn> columns = {
      {"zone", "", std::vector<std::int64_t>{1, 2}},
      {"place, nearest", "", std::vector<std::string>{"fillet a/b", "the \"big\" end, left"}},
      {"peak", "Pa", std::vector<double>{1.5e8, 2}}};
  const std::string quoted =
      "zone,\"place, nearest\",peak [Pa]\n1,fillet a/b,1.5e+08\n2,\"the \"\"big\"\" end, left\",2\n";
  const Directory at;
  EXPECT_THROW(write_csv(at / "ragged.csv", {columns[0], {"x", "m", std::vector<double>{1}}}),
               std::invalid_argument);
  EXPECT_EQ(n_entries(at.path), 0U);
  std::vector<CsvColumn> long_columns = {{"i", "", std::vector<std::int64_t>(5500)},
                                         {"x", "m", std::vector<double>(5500)}};
  std::string rows = "i,x [m]\n";
  for (std::size_t i = 0; i < 5500; ++i) {
    const double x = 1 / (1.0 + double(i));
    std::get<1>(long_columns[0].cells)[i] = std::int64_t(i);
    std::get<0>(long_columns[1].cells)[i] = x;
    rows += std::to_string(i) + "," + shortest(x) + "\n";
  }
  for (const int n_threads : {0, 1, 2, 3, 8}) {
    write_csv(at / "long.csv", long_columns, n_threads);
    EXPECT_EQ(bytes(at / "long.csv"), rows) << n_threads;
    write_csv(at / "short.csv", columns, n_threads);
    EXPECT_EQ(bytes(at / "short.csv"), quoted);
    write_csv(at / "none.csv", {}, n_threads);
    EXPECT_EQ(bytes(at / "none.csv"), "\n");
  }
}

void write_example(const std::filesystem::path& path, Hdf5Compression compression = Hdf5Compression::none) {
  std::vector<double> table(3000);
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = std::sin(static_cast<double>(i));
  const std::vector<std::int32_t> ids = {7, -1, 3, 4};
  Hdf5Writer out(path);
  out.write("/theta", {1.5, -0.25, std::numeric_limits<double>::infinity()},
            {"rad", "angle of the bearing force"});
  out.write("/group/deep/table", table.data(), {1000, 3}, {"Pa", ""}, compression);
  out.write("/ids", ids.data(), {2, 2});
  out.write("/names", std::vector<std::string>{"zwei", "", "größer"}, {});
  out.write("/none", std::vector<double>{});
  out.make_group("/a_group");
  out.attribute("/a_group", "body", std::string("shaft"));
  out.attribute("/", "speed", 0.1);
  out.close();
}

TEST(Hdf5File, HoldsWhatWasWrittenAsTheCLibraryReadsIt) {
  const Directory at;
  write_example(at / "x.h5");
  const hid_t file = H5Fopen((at / "x.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t table = H5Dopen2(file, "group/deep/table", H5P_DEFAULT);
  const hid_t space = H5Dget_space(table);
  hsize_t extent[2] = {};
  ASSERT_EQ(H5Sget_simple_extent_ndims(space), 2);
  H5Sget_simple_extent_dims(space, extent, nullptr);
  EXPECT_EQ(extent[0], 1000U);
  EXPECT_EQ(extent[1], 3U);
  std::vector<double> values(3000);
  ASSERT_GE(H5Dread(table, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  for (std::size_t i = 0; i < values.size(); ++i) ASSERT_EQ(values[i], std::sin(static_cast<double>(i)));
  const hid_t unit = H5Aopen(table, "unit", H5P_DEFAULT), type = H5Aget_type(unit);
  char* text = nullptr;
  ASSERT_GE(H5Aread(unit, type, &text), 0);
  EXPECT_STREQ(text, "Pa");
  H5free_memory(text);
  EXPECT_LE(H5Aexists(table, "description"), 0);
  H5G_stat_t info;  // which all versions have
  ASSERT_GE(H5Gget_objinfo(table, ".", true, &info), 0);
  EXPECT_EQ(info.mtime, 0);
  for (const hid_t id : {type, unit}) type == id ? H5Tclose(id) : H5Aclose(id);
  H5Sclose(space);
  H5Dclose(table);
  EXPECT_EQ(H5Fclose(file), 0);
}

TEST(Hdf5File, ReadsBackItselfWithAndWithoutCompression) {
  const Directory at;
  for (const auto compression : {Hdf5Compression::none, Hdf5Compression::deflate}) {
    write_example(at / "x.h5", compression);
    const Hdf5Reader in(at / "x.h5");
    EXPECT_EQ(in.names("/"), (std::vector<std::string>{"theta", "group", "ids", "names", "none", "a_group"}));
    EXPECT_EQ(in.numbers("/theta"),
              (std::vector<double>{1.5, -0.25, std::numeric_limits<double>::infinity()}));
    EXPECT_EQ(in.text_attribute("/theta", "unit"), "rad");
    EXPECT_EQ(in.text_attribute("/theta", "description"), "angle of the bearing force");
    EXPECT_EQ(in.shape("/group/deep/table"), (std::vector<std::size_t>{1000, 3}));
    EXPECT_EQ(in.numbers("/group/deep/table")[2999], std::sin(2999.));
    std::vector<std::int32_t> ids(4);
    in.read("/ids", ids.data());
    EXPECT_EQ(ids, (std::vector<std::int32_t>{7, -1, 3, 4}));
    EXPECT_EQ(in.texts("/names"), (std::vector<std::string>{"zwei", "", "größer"}));
    EXPECT_TRUE(in.numbers("/none").empty());
    EXPECT_EQ(in.text_attribute("/a_group", "body"), "shaft");
    EXPECT_EQ(in.number_attribute("/", "speed"), 0.1);
    EXPECT_TRUE(in.has("/group/deep/table"));
    EXPECT_FALSE(in.has("/group/shallow/table"));
  }
}

TEST(Hdf5File, TwoWritesGiveTheSameBytes) {
  const Directory at;
  write_example(at / "a.h5");
  sleep(1);  // object times count seconds
  write_example(at / "b.h5");
  EXPECT_EQ(bytes(at / "a.h5"), bytes(at / "b.h5"));
}

TEST(Hdf5File, ErrorsNameFileAndObject) {
  const Directory at;
  write_example(at / "x.h5");
  const auto message = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  };
  const Hdf5Reader in(at / "x.h5");
  testing::internal::CaptureStderr();
  EXPECT_NE(message([&] { in.numbers("/phi"); }).find("x.h5: /phi: "), std::string::npos);
  EXPECT_NE(message([&] { in.numbers("/names"); }).find("x.h5: /names: "), std::string::npos);
  EXPECT_NE(message([&] { in.text_attribute("/theta", "units"); }).find("\"units\""), std::string::npos);
  EXPECT_NE(message([&] { in.text_attribute("/", "speed"); }).find("\"speed\""), std::string::npos);
  EXPECT_NE(message([&] { in.number_attribute("/theta", "unit"); }).find("\"unit\""), std::string::npos);
  EXPECT_NE(message([&] { Hdf5Reader missing(at / "no.h5"); }).find("no.h5"), std::string::npos);
  EXPECT_NE(message([&] { Hdf5Writer out(at / "no/such/directory.h5"); }).find("directory.h5"),
            std::string::npos);
  EXPECT_NE(message([&] {
              Hdf5Writer out(at / "twice.h5");
              out.write("/t", std::vector<double>{1});
              out.write("/t", std::vector<double>{2});
            }).find("twice.h5: /t: "),
            std::string::npos);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
