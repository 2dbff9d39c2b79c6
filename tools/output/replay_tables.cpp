#include "tools/output/replay_tables.hpp"

#include <charconv>
#include <cstddef>
#include <sstream>

#include "tools/output/csv_file.hpp"
#include "tools/output/hdf5_handle.hpp"

namespace puffin::output {
namespace {

constexpr char format[] = "puffin-events";

struct Member {
  const char* name;
  std::size_t at;
  bool real;
};

Hdf5Handle compound(std::size_t size, std::initializer_list<Member> members) {
  Hdf5Handle type(H5Tcreate(H5T_COMPOUND, size), H5Tclose);
  for (const Member& m : members) H5Tinsert(type, m.name, m.at, m.real ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT32);
  return type;
}

using Carrier = ReplayTables::Carrier;
using Slip = ReplayTables::Slip;
using Air = ReplayTables::Air;

Hdf5Handle type_of(const Carrier*) {
  return compound(sizeof(Carrier), {{"id", offsetof(Carrier, id), false},
                                    {"initial", offsetof(Carrier, initial), true},
                                    {"emitted", offsetof(Carrier, emitted), false},
                                    {"drag_rest", offsetof(Carrier, drag_rest), true}});
}
Hdf5Handle type_of(const Slip*) {
  return compound(sizeof(Slip), {{"carrier", offsetof(Slip, carrier), false},
                                 {"slip_class", offsetof(Slip, slip_class), false},
                                 {"seconds", offsetof(Slip, seconds), true},
                                 {"metres", offsetof(Slip, metres), true}});
}
Hdf5Handle type_of(const Air*) {
  return compound(sizeof(Air), {{"set", offsetof(Air, set), false},
                                {"mechanism", offsetof(Air, mechanism), false},
                                {"released", offsetof(Air, released), true},
                                {"in_air", offsetof(Air, in_air), true},
                                {"emitted", offsetof(Air, emitted), true},
                                {"deposited", offsetof(Air, deposited), true}});
}
Hdf5Handle type_of(const double*) { return {H5Tcopy(H5T_NATIVE_DOUBLE), H5Tclose}; }

template <class Row>
void write(const Hdf5File& file, const char* name, const std::vector<Row>& rows) {
  const Hdf5Handle type = type_of(static_cast<const Row*>(nullptr));
  const Hdf5Handle stored = file.create_growing(file.id(), name, type, 4096);
  file.append(stored, type, rows.data(), rows.size());
}

template <class Row>
std::vector<Row> read(const Hdf5File& file, const char* name) {
  const Hdf5Handle stored(file.good(H5Dopen2(file.id(), name, H5P_DEFAULT), std::string("find /") + name + " in"),
                          H5Dclose);
  std::vector<Row> rows(file.stored_length(stored));
  const Hdf5Handle type = type_of(static_cast<const Row*>(nullptr));
  if (!rows.empty()) file.good(H5Dread(stored, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()), "read");
  return rows;
}

}  // namespace

void write_replay_tables(const std::filesystem::path& events, const ReplayTables& tables) {
  const Hdf5File file = Hdf5File::adding(events, format);
  write(file, "replay_carriers", tables.carriers);
  write(file, "replay_slip", tables.slip);
  write(file, "replay_air", tables.air);
  write(file, "replay_rates", tables.rates);
  std::string names;
  for (const auto& name : tables.scalars) names += name + '\n';
  file.set_text(file.id(), "replay_scalars", names);
  file.set_text(file.id(), "replay_end", shortest(tables.end));
  file.flush();
}

ReplayTables read_replay_tables(const std::filesystem::path& events) {
  const Hdf5File file = Hdf5File::reading(events, format);
  const Hdf5Quiet quiet;
  if (H5Lexists(file.id(), "replay_carriers", H5P_DEFAULT) <= 0)
    throw OutputError(events.string() +
                      " holds nothing to replay: the run carried no fines through air, or fines came back to carriers "
                      "(fines.reattachment, fines.pick_up), or others were in the air at the start or came in "
                      "through an opening, or an older version wrote it");
  ReplayTables tables;
  tables.carriers = read<Carrier>(file, "replay_carriers");
  tables.slip = read<Slip>(file, "replay_slip");
  tables.air = read<Air>(file, "replay_air");
  tables.rates = read<double>(file, "replay_rates");
  std::istringstream names(file.text(file.id(), "replay_scalars"));
  for (std::string name; std::getline(names, name);) tables.scalars.push_back(name);
  const std::string end = file.text(file.id(), "replay_end");
  if (std::from_chars(end.data(), end.data() + end.size(), tables.end).ec != std::errc())
    throw OutputError(events.string() + " is damaged: '" + end + "' is no moment at which a run ends");
  return tables;
}

}  // namespace puffin::output
