#include "harness/sweep/earlier_rows.h"

#include "core/base/error.h"
#include "core/base/hash.h"
#include "harness/table/csv.h"
#include "harness/table/files.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace hybray {
namespace {

// A table file as it was found, and the manifest that should describe it.
struct Found {
  std::filesystem::path file;
  std::string text;
  CsvTable table;
  std::optional<EarlierManifest> manifest;  // if it is of this table

  size_t rows() const { return table.rows.size(); }
};

Found look_at(const std::filesystem::path& table, const std::filesystem::path& manifest,
              const std::string& name) {
  Found found{table, {}, {}, read_manifest(manifest)};
  try {
    found.text = read_file(table);
    found.table = parse_whole_rows(found.text);
  } catch (const InputError&) {  // it is not there
  }
  if (found.manifest && found.manifest->table != name + ".csv") found.manifest.reset();
  return found;
}

// Why its rows cannot be taken over; empty: they can.
std::string obstacle(const Found& found, const std::string& header, const RowOrigin& origin) {
  if (!found.manifest) return "there is no manifest of it";
  if (csv_line(found.table.header) != header) return "its columns are others";
  const std::string parts = difference(found.manifest->origin, origin);
  return parts.empty() ? "" : "it was made with another: " + parts;
}

// Adds the rows that are not there yet; whether there was one.
bool add_rows(const CsvTable& table, TableLines& lines) {
  const size_t before = lines.size();
  for (const auto& row : table.rows) lines.emplace(row.front(), csv_line(row));
  return lines.size() > before;
}

void add_sessions(const std::vector<Session>& more, std::vector<Session>& sessions) {
  for (const Session& session : more) {
    const auto known = [&](const Session& s) { return s.start_unix_s == session.start_unix_s; };
    if (std::none_of(sessions.begin(), sessions.end(), known)) sessions.push_back(session);
  }
  std::sort(sessions.begin(), sessions.end(),
            [](const Session& a, const Session& b) { return a.start_unix_s < b.start_unix_s; });
}

// A session that was killed could not say how long it took: it counts to its last row.
void end_killed_session(std::vector<Session>& sessions, const std::filesystem::path& partial) {
  for (Session& session : sessions) {
    if (!session.wall_time_s)
      session.wall_time_s = std::max(0.0, modified_unix_s(partial) - session.start_unix_s);
  }
}

}  // namespace

EarlierRows find_earlier_rows(const std::filesystem::path& folder, const std::string& name,
                              const std::string& header, const RowOrigin& origin) {
  EarlierRows earlier;
  const auto remark = [&](const Found& found, const std::string& reason) {
    earlier.remarks.push_back(
        fmt::format("the {} rows of {} are not taken over: {}", found.rows(), found.file.string(), reason));
  };

  Found partial = look_at(folder / (name + ".csv.partial"), folder / "manifest.json.partial", name);
  if (partial.rows() > 0) {
    const std::string reason = obstacle(partial, header, origin);
    if (reason.empty()) {
      earlier.partial = PartialRows::taken_over;
      add_rows(partial.table, earlier.lines);
      earlier.sessions = std::move(partial.manifest->sessions);
      end_killed_session(earlier.sessions, partial.file);
      earlier.fresh = partial.manifest->fresh;
    } else {
      earlier.partial = PartialRows::foreign;
      remark(partial, reason);
    }
  }
  if (earlier.fresh) return earlier;  // whoever began it did not want the complete table's rows

  const Found complete = look_at(folder / (name + ".csv"), folder / "manifest.json", name);
  if (complete.rows() == 0) return earlier;
  std::string reason = obstacle(complete, header, origin);
  if (reason.empty() && complete.manifest->content_hash != hex(hash_text(complete.text)))
    reason = "it is not as its manifest describes it";
  if (!reason.empty())
    remark(complete, reason);
  else if (add_rows(complete.table, earlier.lines))
    add_sessions(complete.manifest->sessions, earlier.sessions);
  return earlier;
}

}  // namespace hybray
