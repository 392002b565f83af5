#include "core/output/run_log.hpp"

#include <array>
#include <ctime>
#include <nlohmann/json.hpp>
#include <system_error>

#include "core/base/error.hpp"
#include "core/output/archive_files.hpp"

namespace tushar::output {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

/// The current date and time (UTC) as text: `2026-01-31T12:00:00Z`.
std::string dateNow() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::array<char, sizeof "2026-01-31T12:00:00Z"> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

Json entryOf(const RunRecord& record) {
  Json entry = {{"started", dateNow()},      {"restart", record.restarts},    {"from_step", record.step},
                {"command", record.command}, {"overrides", record.overrides}, {"ranks", record.ranks},
                {"threads", record.threads}, {"hosts", record.hosts},         {"version", record.version},
                {"build", record.build},     {"commit", record.commit},       {"compiler", record.compiler},
                {"flags", record.flags}};
  for (const auto& [name, version] : record.libraries) entry["libraries"][name] = version;
  entry["end"] = nullptr;
  return entry;
}

/// The runs listed in a file; none if there is no file, or if the file is damaged (it is then moved away).
Json runsIn(const fs::path& file) {
  Json empty = {{"format", RunLog::format}, {"runs", Json::array()}};
  const auto text = textOf(file);
  if (!text) return empty;
  Json found = Json::parse(*text, nullptr, false);
  if (found.is_object() && found.contains("runs") && found["runs"].is_array()) return found;
  std::error_code ignored;
  fs::rename(file, fs::path(file) += ".damaged", ignored);
  return empty;
}

/// The runs as text; bytes that are not UTF-8 are replaced.
std::string textOf(const Json& runs) { return runs.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace

std::string RunLog::refusalOf(const std::string& text) {
  const Json found = Json::parse(text, nullptr, false);
  if (!found.is_object() || !found.contains("format")) return "";
  const Json& number = found["format"];
  if (number.is_number_integer() && number.get<double>() <= format) return "";
  return fmt::format("run.json of the archive has format {}, but this sus supports only formats up to {}",
                     number.dump(), format);
}

RunLog::RunLog(const fs::path& folder, const RunRecord& record) : file_(folder / "run.json") {
  Json runs = runsIn(file_);
  runs["format"] = format;
  runs["runs"].push_back(entryOf(record));
  runs_ = textOf(runs);
  replaceFile(file_, runs_);
}

// NOLINTNEXTLINE(bugprone-exception-escape): it parses only what it has written
RunLog::~RunLog() {
  if (!ended_) end("error", -1, static_cast<int>(ExitCode::failure));
}

void RunLog::addLibrary(const std::string& name, const std::string& version) {
  Json runs = Json::parse(runs_);
  runs["runs"].back()["libraries"][name] = version;
  runs_ = textOf(runs);
}

void RunLog::end(const std::string& why, int step, int exitCode) {
  ended_ = true;
  Json runs = Json::parse(runs_);
  Json end = {{"date", dateNow()}, {"why", why}, {"exit", exitCode}};
  if (step >= 0) end["step"] = step;
  runs["runs"].back()["end"] = end;
  try {
    replaceFile(file_, textOf(runs));
  } catch (const FileError&) {
    // Losing the log is no failure of the run, whose errors have been reported.
  }
}

}  // namespace tushar::output
