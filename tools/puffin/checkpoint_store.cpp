#include "tools/puffin/checkpoint_store.hpp"

#include <fstream>
#include <sstream>
#include <string_view>

#include "cases/micromodel_file.hpp"
#include "cases/write_case.hpp"
#include "coupling/checkpoint/checkpoint.hpp"
#include "coupling/checkpoint/hash.hpp"
#include "tools/output/csv_file.hpp"
#include "tools/output/output_error.hpp"
#include "tools/puffin/build_info.hpp"
#include "tools/puffin/console.hpp"

namespace puffin::tools {

namespace {

constexpr std::string_view cannot_be_used = " cannot be used: ",
                           none_is_sound = " is sound; begin anew with another --out";

template <class T>
std::uint64_t hash_of(const T& values, std::uint64_t seed = 0) {
  return coupling::xxh64(std::as_bytes(std::span(values)), seed);
}

/// The first line in which two texts differ, of each.
std::pair<std::string, std::string> first_difference(const std::string& a, const std::string& b) {
  std::istringstream left(a), right(b);
  for (std::string x, y;;) {
    const bool more_x = static_cast<bool>(std::getline(left, x)), more_y = static_cast<bool>(std::getline(right, y));
    if (!more_x) x = "(nothing)";
    if (!more_y) y = "(nothing)";
    if (x != y || (!more_x && !more_y)) return {x.substr(0, x.find("  #")), y.substr(0, y.find("  #"))};
  }
}

/// What files say that are read at every start, of a resumed run too. (A dose and the air at the start are in the
/// checkpoint.)
void hash_files(const cases::Simulation& s, std::ostream& text) {
  const cases::Air& air = s.description.air;
  const auto add = [&](const char* key, const std::string& file) {
    text << key << " = " << hash_of(output::read_whole(file)) << '\n';
  };
  for (const cases::Boundary& b : air.boundaries)
    if (!b.profile_file.empty()) add("what the file of a profile holds", b.profile_file);
  if (const auto* force = std::get_if<cases::ForceFile>(&air.body_force))
    add("what air.body_force.file holds", force->file);
  if (air.model != cases::AirModel::frozen) return;
  if (const auto* field = std::get_if<cases::FieldFile>(&air.frozen)) add("what air.field.file holds", field->file);
  if (!s.stored_field) return;
  std::uint64_t samples = 0;
  constexpr int parts = 8;
  const cases::Vec3 low = s.tree->min(), size = s.tree->max() - low;
  for (int n = 0; n < parts * parts * parts; ++n) {
    const cases::Vec3 place(n % parts + 0.5, n / parts % parts + 0.5, n / parts / parts + 0.5);
    const cases::Vec3 u = s.stored_field(low + size.cwiseProduct(place) / parts);
    samples = coupling::xxh64(std::as_bytes(std::span(u.data(), 3)), samples);
  }
  text << "velocities of air.field.run = " << samples << '\n';
}

}  // namespace

std::string identity_of(const cases::Simulation& s) {
  cases::Case c = s.description;
  c.numerics.threads = 0;
  c.stop.time = 0.0;
  c.output.checkpoint = {};
  c.reference.clear();
  c.provenance.clear();
  std::ostringstream text;
  text << "program = " << build_info().version << '\n' << cases::write_resolved(c);
  text << "layout of the outputs = 2\n";  // to be raised with RecorderState
  text << "dx = " << output::shortest(s.dx) << '\n';
  text << "time step at the reference speed = " << output::shortest(s.models.time_step.reference_dt) << '\n';
  if (s.models.time_step.follow)
    text << "largest speed that the time step follows = " << output::shortest(s.models.time_step.reference_speed)
         << '\n';
  std::uint64_t surface = hash_of(s.surface.patches.of_triangle);
  for (const auto& v : s.surface.mesh.vertices)
    surface = coupling::xxh64(std::as_bytes(std::span(v.data(), 3)), surface);
  for (const auto& t : s.surface.mesh.triangles) surface = hash_of(t, surface);
  text << "surface = " << surface << '\n';
  text << "lattice = " << coupling::fingerprint(s.state) << '\n';
  if (c.fines && !c.fines->micromodels.empty())
    text << "micro-models = " << hash_of(cases::micromodels_with_tables(c.fines->micromodels)) << '\n';
  hash_files(s, text);
  return text.str();
}

CheckpointStore::CheckpointStore(const cases::Simulation& s, const output::OutputFolder& folder)
    : folder_(folder),
      identity_(identity_of(s)),
      interval_(s.description.output.checkpoint.wall),
      keep_(s.description.output.checkpoint.keep) {
  for (const auto& file : output::list_checkpoints(folder.path()))
    next_number_ = std::max(next_number_, output::checkpoint_number(file) + 1);
}

bool CheckpointStore::due() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - last_).count() >= interval_;
}

void CheckpointStore::write(coupling::Checkpoint& checkpoint) {
  coupling::ByteWriter{checkpoint.renew("case")}(identity_);
  coupling::write_checkpoint(folder_.file(output::checkpoint_name(next_number_++)), checkpoint);
  last_ = std::chrono::steady_clock::now();
  const auto files = output::list_checkpoints(folder_.path());
  std::error_code error;  // one that stays does no harm
  for (std::size_t n = static_cast<std::size_t>(keep_); n < files.size(); ++n) std::filesystem::remove(files[n], error);
}

void CheckpointStore::require_same_case(const coupling::Checkpoint& checkpoint) const {
  std::string identity;
  coupling::ByteReader(checkpoint.at("case"), "case")(identity);
  if (identity == identity_) return;
  const auto [theirs, ours] = first_difference(identity, identity_);
  const bool follows = theirs.starts_with("statistics = ") || theirs.starts_with("average_from = ");
  throw coupling::CheckpointForeign(
      "it belongs to another case: there '" + theirs + "', now '" + ours + "'" +
      (follows ? " (which follows from stop.time if the case does not give it: set it)" : "") +
      "; resume with the case file, --preset and --set of the first part, or begin anew "
      "with another --out");
}

void CheckpointStore::restore_newest(std::size_t longest, const std::function<void(const coupling::Checkpoint&)>& use) {
  std::string damages;
  for (const auto& file : output::list_checkpoints(folder_.path())) try {
      const coupling::Checkpoint checkpoint = coupling::read_checkpoint(file, longest);
      require_same_case(checkpoint);
      use(checkpoint);
      log_info("going on from " + file.string());
      return;
    } catch (const coupling::CheckpointDamaged& e) {
      log_warning(file.string() + " is damaged: " + e.what() + "; trying the one before it");
      damages += "; " + file.string() + ": " + e.what();
    } catch (const coupling::CheckpointForeign& e) {
      throw coupling::CheckpointForeign(file.string() + std::string(cannot_be_used) + e.what());
    }
  throw output::OutputError("no checkpoint of " + folder_.path().string() + std::string(none_is_sound) + damages);
}

bool cannot_go_on(std::string_view message) {
  return message.find(cannot_be_used) != std::string_view::npos ||
         message.find(none_is_sound) != std::string_view::npos;
}

}  // namespace puffin::tools
