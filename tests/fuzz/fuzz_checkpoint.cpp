// Any bytes as a checkpoint. First as a whole file: refused, or sections no longer than the file. Then past the
// checksums, as one section of a sound checkpoint (the first byte says which): refused, or restored into a state that
// can be saved again.

#include <cstdint>
#include <span>

#include "coupling/checkpoint/checkpoint.hpp"
#include "coupling/checkpoint/file.hpp"
#include "tests/coupling/checkpoint/coupled_scene.hpp"
#include "tests/fuzz/bytes_as_file.hpp"

using namespace puffin::coupling;

namespace {

struct Victim {
  Victim() : sim(coupled_simulation()) {
    while (sim->state.time < 0.7e-3) advance(sim->models, 0.7e-3, sim->state);
    save(sim->state, sound);
  }
  std::unique_ptr<puffin::cases::Simulation> sim;
  Checkpoint sound;
};

Victim& victim() {
  static Victim one;
  return one;
}

}  // namespace

/// Of libFuzzer: before its clock for each input starts. (The program that replays the corpus does without.)
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  victim();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  try {
    demand(parse_checkpoint(bytes).size() <= size);
  } catch (const CheckpointDamaged&) {
  } catch (const CheckpointForeign&) {
  }
  if (size == 0) return 0;
  Victim& v = victim();
  Checkpoint altered = v.sound;
  Section& section = altered.sections[data[0] % altered.sections.size()];
  // A short input replaces the beginning, where lengths and indices are; a long one the whole section.
  const auto given = bytes.subspan(1);
  if (given.size() < 256 && given.size() < section.bytes.size())
    std::copy(given.begin(), given.end(), section.bytes.begin());
  else
    section.bytes.assign(given.begin(), given.end());
  try {
    restore(altered, v.sim->state);
    Checkpoint again;
    save(v.sim->state, again);
    demand(again.sections.size() == altered.sections.size());
  } catch (const CheckpointDamaged&) {
  }
  restore(v.sound, v.sim->state);  // however far the altered one got
  return 0;
}
