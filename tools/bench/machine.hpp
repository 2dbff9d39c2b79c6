#pragma once
// What a benchmark must say of the machine it ran on, so that its rows can be judged.

#include <string>

namespace puffin::bench {

struct Machine {
  std::string processor;  // model name
  std::string isa;        // instruction set of the kernels
  int cores = 0;
  std::string commit;  // of the source
};

/// Reads /proc/cpuinfo; unknown fields stay empty.
Machine describe_machine(const std::string& commit);

/// Processor time that processes other than this one and its ended children used between construction and `share()`,
/// over the time of all cores: 0 on a quiet machine. A stolen core halves two threads, so figures with a share above a few per cent are no measurement.
class ForeignLoad {
 public:
  ForeignLoad();
  double share() const;

 private:
  struct Ticks {
    double all = 0.0, busy = 0.0, own = 0.0;
  };
  static Ticks now();
  Ticks start_;
};

}  // namespace puffin::bench
