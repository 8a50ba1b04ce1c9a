#include "tests/cases/program/program.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tests/cases/program/start_request.h"

namespace cases {

fs::path shipped(const std::string& name) {
  return fs::path(SOURCE_DIR) / "pipelines/scenes" / name;
}

std::string with_edits(std::string text, const Edits& edits) {
  for (const auto& [from, to] : edits) {
    const auto at = text.find(from);
    if (at == std::string::npos || text.find(from, at + 1) != std::string::npos)
      throw std::runtime_error("not exactly one place for: " + from);
    text.replace(at, from.size(), to);
  }
  return text;
}

std::string edited(const std::string& scene, const Edits& edits) {
  return with_edits(results_test::bytes(shipped(scene)), edits);
}

std::string without(const std::string& scene, const std::string& from, const std::string& to) {
  std::string text = results_test::bytes(shipped(scene));
  const auto begin = text.find("\n" + from + "\n"), end = text.find("\n" + to + "\n");
  if (begin == std::string::npos || end == std::string::npos || end < begin)
    throw std::runtime_error(scene + ": no lines " + from + " .. " + to);
  return text.erase(begin, end - begin);
}

std::string shaft_alone(const Edits& edits) {
  return with_edits(without("vibratory_mill.toml", "[chamber]", "[zones]"), edits);
}

std::string chamber_alone(const Edits& edits) {
  return with_edits(without("vibratory_mill.toml", "[shaft]", "[chamber]"), edits);
}

Edits specified_chamber() {
  return {
      {"inner_length = \"210 mm\"", "inner_length = \"280 mm\""},
      {"wall = \"12 mm\"", "wall = \"6 mm\""},
      {"outer_radius = \"186 mm\"\nthickness = \"8 mm\"", "outer_radius = \"175 mm\"\nthickness = \"12 mm\""},
      {"thickness = \"15 mm\"\nheight = \"170 mm\"", "thickness = \"14 mm\"\nheight = \"140 mm\""},
      {"lug_width = \"50 mm\"\nplace = \"75 mm\"", "lug_width = \"40 mm\"\nplace = \"100 mm\""},
      {"pad = [\"50 mm\", \"20 mm\", \"30 mm\"]", "pad = [\"50 mm\", \"30 mm\", \"30 mm\"]"},
      {"mass = \"2 kg\"", "mass = \"6.04 kg\""},
      {"polar_inertia = \"0.0296 kg m2\"", "polar_inertia = \"0.0925 kg m2\""}};
}

Edits coarse() {
  return {{"cells_per_fillet_quarter = 8", "cells_per_fillet_quarter = 2"},
          {"sectors = 16", "sectors = 8"},
          {"snapshots = 12", "snapshots = 2"},
          {"pictures = true", "pictures = false"},
          {"instants_per_turn = 120", "instants_per_turn = 24"}};
}

Edits operator+(Edits a, const Edits& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::string steel_of(const std::string& body) {
  return "\n[" + body + R"(.material]
name = "C45+N"
youngs_modulus = "206 GPa"
poisson_ratio = 0.3
density = "7850 kg/m3"
yield_strength = "305 MPa"
)";
}

fs::path write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

std::string on_its_own_mesh(const fs::path& directory, const std::string& arguments) {
  std::istringstream words(arguments);
  std::string command, scene;
  words >> command >> scene;
  scene.erase(std::remove(scene.begin(), scene.end(), '\''), scene.end());
  const auto asks = [](const std::string& text, const std::string& what) {
    return text.find(what) != std::string::npos;
  };
  const bool solves = command == "run" || command == "history";
  if (!solves || asks(arguments, "--tolerance") || asks(arguments, "--time-limit")) return arguments;
  const auto file = scene[0] == '/' ? fs::path(scene) : directory / scene;
  if (fs::is_regular_file(file)) {
    const auto text = '\n' + results_test::bytes(file);
    if (asks(text, "\ntolerance =") || asks(text, "\ntime_limit =")) return arguments;
  }
  return arguments + " --tolerance none";
}

Outcome millstress(const fs::path& directory, const std::string& arguments, const std::string& before) {
  return as_a_user(directory, on_its_own_mesh(directory, arguments), before);
}

std::string two_ranks() {
  return "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 "
         "OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_btl_vader_single_copy_mechanism=none '" MPIEXEC "' -n 2";
}

std::string shell_command(const Start& start) {
  auto arguments = start.arguments;
  const auto begins_with = [&](const char* command) { return arguments.rfind(command, 0) == 0; };
  const bool solves = begins_with("run ") || begins_with("history ") || begins_with("accuracy ");
  if (solves && arguments.find("--threads") == std::string::npos) arguments += " --threads 1";
  const auto file = [&](const std::string& name) { return "'" + (start.directory / name).string() + "'"; };
  return "cd '" + start.directory.string() + "' && " + start.before + " && XDG_CACHE_HOME=" + file("cache") +
         " " + start.launcher + " '" MILLSTRESS "' " + arguments + " > " + file(start.name + "stdout.txt") +
         " 2> " + file(start.name + "stderr.txt");
}

Outcome outcome_of(const Start& start, int status) {
  const auto out = start.directory / (start.name + "stdout.txt"),
             err = start.directory / (start.name + "stderr.txt");
  Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, results_test::bytes(out),
                  results_test::bytes(err)};
  fs::remove(out);
  fs::remove(err);
  return outcome;
}

namespace {

/// Begins a process of the program that waits for starts (waiting_program.cc) until this one has ended.
/// @return what stands before the program to have it started there; nothing if none waits
std::string begin_waiting_program() {
#ifdef WAITING_PROGRAM
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends) != 0) return "";
  const auto own = std::to_string(ends[0]), others = std::to_string(ends[1]);
  if (fork() == 0) {
    close(ends[1]);
    const int nowhere = open("/dev/null", O_RDWR);
    for (int stream = 0; stream < 3; ++stream) dup2(nowhere, stream);
    setenv("LD_PRELOAD", WAITING_PROGRAM, 1);
    setenv(start_request::socket_variable, own.c_str(), 1);
    execl(MILLSTRESS, MILLSTRESS, nullptr);
    _exit(start_request::cannot_start);
  }
  close(ends[0]);
  return start_request::socket_variable + ("=" + others) + " '" HAND_OVER "'";
#else
  return "";
#endif
}

}  // namespace

Outcome as_a_user(const fs::path& directory, const std::string& arguments, const std::string& before) {
  Start start{directory, arguments, before};
  if (before == Start().before) {
    static const auto waiting = begin_waiting_program();
    start.launcher = waiting;
  }
  return outcome_of(start, std::system(shell_command(start).c_str()));
}

std::map<std::string, std::string> contents(const fs::path& directory) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(directory)) {
    if (!entry.is_regular_file()) continue;
    std::string text = results_test::bytes(entry.path());
    if (entry.path().filename() == "summary.json") {  // ends with timing
      auto json = nlohmann::ordered_json::parse(text);
      json.erase("timing");
      text = json.dump();
    }
    if (entry.path().filename() == "run.json") {  // so does the table that was printed
      auto json = nlohmann::ordered_json::parse(text);
      json.erase("table");
      json.erase("full_table");
      text = json.dump();
    }
    if (entry.path().filename() == "manifest.json") {  // their checksums are those of the timing too
      auto json = nlohmann::ordered_json::parse(text);
      json["files"].erase("summary.json");
      json["files"].erase("run.json");
      json["files"].erase("report.html");
      json.erase("checksum");
      text = json.dump();
    }
    if (entry.path().filename() == "report.html") text.resize(text.find("<details><summary>Time and memory"));
    files[fs::relative(entry.path(), directory).string()] = std::move(text);
  }
  return files;
}

nlohmann::json summary(const fs::path& results) {
  return nlohmann::json::parse(results_test::bytes(results / "summary.json"));
}

fs::path cached_responses(const fs::path& directory, const std::string& results, const std::string& body) {
  const auto run = nlohmann::json::parse(results_test::bytes(directory / results / "run.json"));
  return directory / "cache/millstress" / (run.at("responses").at(body).get<std::string>() + ".h5");
}

/// A cell up to its comma, or a text in quotes with the commas in it.
static std::string next_cell(std::istringstream& row) {
  std::string cell, more;
  std::getline(row, cell, ',');
  while (std::count(cell.begin(), cell.end(), '"') % 2 == 1 && std::getline(row, more, ','))
    cell += "," + more;
  return cell;
}

std::map<std::string, std::vector<double>> csv(const fs::path& file) {
  std::ifstream in(file);
  std::string line, cell;
  std::vector<std::string> names;
  std::getline(in, line);
  for (std::istringstream header(line); std::getline(header, cell, ',');)
    names.push_back(cell.substr(0, cell.find(" [")));
  std::map<std::string, std::vector<double>> columns;
  while (std::getline(in, line)) {
    std::istringstream row(line);
    for (const auto& name : names) columns[name].push_back(std::strtod(next_cell(row).c_str(), nullptr));
  }
  return columns;
}

std::map<std::string, std::vector<double>> csv_in_si(const fs::path& file) {
  const std::map<std::string, double> in_si{{"MPa", 1e6}, {"mm", 1e-3}, {"mm3", 1e-9}, {"deg", M_PI / 180}};
  auto columns = csv(file);
  std::ifstream in(file);
  std::string line, title;
  std::getline(in, line);
  for (std::istringstream header(line); std::getline(header, title, ',');)
    if (const auto open = title.find(" ["); open != std::string::npos)
      if (const auto unit = in_si.find(title.substr(open + 2, title.size() - open - 3)); unit != in_si.end())
        for (double& value : columns[title.substr(0, open)]) value *= unit->second;
  return columns;
}

nlohmann::json json_of(const fs::path& directory, const std::string& arguments) {
  const auto run = millstress(directory, arguments);
  EXPECT_EQ(run.exit_code, 0) << arguments << "\n" << run.err;
  return nlohmann::json::parse(run.out);
}

}  // namespace cases
