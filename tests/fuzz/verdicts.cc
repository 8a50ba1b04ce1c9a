#include "tests/fuzz/verdicts.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/common/failure.h"

namespace fuzz {
namespace {

namespace fs = std::filesystem;

/// Lines end in LF, CR LF, or CR alone, as tables of samples may.
long lines_in(const std::string& text) {
  long n = 1;
  for (std::size_t i = 0; i < text.size(); ++i)
    n += text[i] == '\n' || (text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n'));
  return n;
}

/// Each finding has a sentence that says what to do, and a place in its file.
std::string fault_of_findings(const std::vector<pipelines::SceneFinding>& findings) {
  if (findings.empty()) return "refused without a finding";
  std::map<std::string, long> n_lines;  // of each file: there may be a hundred thousand findings
  for (const auto& finding : findings) {
    if (finding.remedy.empty()) return "no remedy: " + finding.text();
    if (finding.file.empty()) return "no file: " + finding.text();
    if (n_lines.count(finding.file) == 0) {
      const auto text = read_bytes(finding.file);
      n_lines[finding.file] = lines_in(text);
    }
    if (finding.line > n_lines[finding.file]) return "no such line: " + finding.text();
  }
  return "";
}

}  // namespace

std::string read_bytes(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

std::string fault_of_message(const std::string& message, const std::vector<std::string>& named) {
  const auto has = [&](const std::string& words) { return message.find(words) != std::string::npos; };
  if (has("internal error")) return message;
  if (message.empty()) return "nothing is said";
  if (std::none_of(named.begin(), named.end(), has)) return "no file is named: " + message;
  return "";
}

Verdict judged(const std::string& named, const std::function<std::string()>& action) {
  try {
    auto fault = action();
    return {fault.empty(), std::move(fault)};
  } catch (const pipelines::SceneError& error) {
    auto fault = fault_of_findings(error.findings());
    return {false, fault.empty() ? fault_of_message(error.what(), {named}) : fault};
  } catch (...) {  // of any kind: what main would say
    return {false, fault_of_message(pipelines::failure_in_flight().message, {named})};
  }
}

std::map<std::string, std::string> all_files(const fs::path& directory) {
  std::map<std::string, std::string> files;
  if (!fs::is_directory(directory)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(directory))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), directory).string()] = read_bytes(entry.path());
  return files;
}

std::string difference(const std::map<std::string, std::string>& a,
                       const std::map<std::string, std::string>& b) {
  for (const auto& [name, bytes] : a) {
    const auto found = b.find(name);
    if (found == b.end() || found->second != bytes) return name;
  }
  for (const auto& [name, bytes] : b)
    if (a.count(name) == 0) return name;
  return "";
}

std::string fault_of_leftovers(const fs::path& directory) {
  for (const auto& entry : fs::recursive_directory_iterator(directory))
    if (entry.path().filename().string().front() == '.') return "left over: " + entry.path().string();
  return "";
}

}  // namespace fuzz
