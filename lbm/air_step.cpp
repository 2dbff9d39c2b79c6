// One step of the air: collision of the cells, then what comes back from walls, openings and periodic faces; one after
// the other or in one pass.

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

#include "lbm/air.hpp"
#include "lbm/link_schedule.hpp"
#include "lbm/markers.hpp"
#include "lbm/openings.hpp"
#include "lbm/parts.hpp"
#include "lbm/slip.hpp"
#include "lbm/wall_model.hpp"
#include "lbm/wall_schemes.hpp"

namespace puffin::lbm {

namespace {

template <class T>
void cross_periodic_faces(const Links& links, Parity last, Populations<T>& p) {
  const auto cross_all = [&](const std::vector<Links::Image>& images, bool to_ghost) {
    oneapi::tbb::parallel_for(
        oneapi::tbb::blocked_range<std::size_t>(0, images.size() / 2, 64),
        [&](const auto& range) {
          for (std::size_t k = range.begin(); k < range.end(); ++k) {
            const Links::Image& first = images[2 * k];
            T* f = p.f.data() + first.direction * p.stride;
            const std::ptrdiff_t count = images[2 * k + 1].ghost - first.ghost + 1;
            if (to_ghost)
              std::copy_n(f + first.active, count, f + first.ghost);
            else
              std::copy_n(f + first.ghost, count, f + first.active);
          }
        },
        oneapi::tbb::static_partitioner());
  };
  // Every stretch has places of its own to write; corners read what the faces have written, so they come after.
  cross_all(links.images, last == Parity::even);
  cross_all(links.corner_images, true);
}

/// Half-way reflection on both sides of a wall thinner than a cell: what left each side comes back to it.
template <class T>
void reflect_at_thin_walls(const Rows& rows, const Links& links, Populations<T>& p) {
  for (const auto& link : links.thin) {
    const int i = link.direction, o = d3q19::opposite(i);
    std::swap(p.f[o * p.stride + link.slot],
              p.f[i * p.stride + link.slot + neighbour_offset(rows.runs()[link.run], i)]);
  }
}

template <class T>
KernelInput<T> kernel_input(const CollisionConstants& constants, const Drive& drive, Air& air, Populations<T>& p) {
  KernelInput<T> input;
  input.f = p.f.data();
  input.stride = p.stride;
  input.runs = air.rows.runs().data();
  input.active_lanes = air.rows.active_lanes().data();
  input.run_flags = air.markers ? air.markers->run_flags.data() : air.run_flags.data();
  input.parity = p.next;
  input.constants = constants;
  input.les = air.les.data();
  input.constants.hrr_sigma = air.options.hrr_sigma;
  if (air.gradients.wanted()) {
    find_velocity_gradients(air.rows, p, drive.speed, constants.tau0, air.options.isa, air.gradients, air.les);
    if (air.gradients.viscosity_wanted) input.constants.from_stress = 0.0;
    for (int n = 0; n < 6; ++n) input.strain[n] = air.gradients.strain[n].data();
  }
  for (int d = 0; d < 3; ++d) {
    input.uniform_force[d] = drive.uniform_force[d];
    input.forced_everywhere = input.forced_everywhere || drive.uniform_force[d] != 0.0;
  }
  std::array<const float*, 3> force{air.force.x.data(), air.force.y.data(), air.force.z.data()};
  if (air.markers)
    for (int d = 0; d < 3; ++d) force[d] = air.markers->force[d].data();
  const std::array<float*, 4> moments{air.moments.density_excess.data(), air.moments.ux.data(), air.moments.uy.data(),
                                      air.moments.uz.data()};
  for (int d = 0; d < 3; ++d) input.force[d] = force[d];
  for (int d = 0; d < 4; ++d) input.moments[d] = moments[d];
  return input;
}

/// Collides the cells of chunks.
template <class T>
class Collide {
 public:
  Collide(const CollisionConstants& constants, const Drive& drive, Air& air, Populations<T>& p)
      : input_(kernel_input(constants, drive, air, p)),
        kernel_(select_kernel<T>(air.options.law, constants.rescale != 1.0, air.options.isa)) {}
  KernelReport operator()(const Chunk& chunk) const {
    KernelInput<T> mine = input_;
    mine.first_run = chunk.first_run;
    mine.last_run = chunk.last_run;
    return kernel_(mine);
  }

 private:
  KernelInput<T> input_;
  Kernel<T> kernel_;
};

/// Applies the links of chunks.
template <class T>
class ApplyLinks {
 public:
  ApplyLinks(const Drive& drive, const Air& air, Populations<T>& p)
      : drive_(drive),
        air_(air),
        schedule_(*air.links.schedule),
        p_(p),
        kernel_(select_wall_kernel<T>(air.options.isa)) {
    walls_.f = p.f.data();
    walls_.stride = p.stride;
    walls_.runs = air.rows.runs().data();
    walls_.walls = schedule_.runs.data();
    walls_.partner = air.links.partner.data();
    walls_.moving = air.links.moving.data();
    walls_.returned = air.links.returned.data();
    walls_.groups = schedule_.groups.data();
    walls_.places = schedule_.places.data();
    walls_.group_partner = schedule_.partner.data();
    walls_.group_moving = schedule_.moving.data();
    walls_.group_returned = schedule_.returned.data();
    walls_.parity = p.next;
    walls_.wall_speed = wall_speed(drive, air);
  }
  /// The walls that can be done right after `chunk`, when all chunks from `begin` on are collided.
  void ready_walls(int chunk, int begin) const {
    walls(schedule_.waiting_runs.ready(chunk, begin), schedule_.waiting_groups.ready(chunk, begin));
  }
  /// The other walls that waited for `chunk`.
  void late_walls(int chunk, int begin) const {
    walls(schedule_.waiting_runs.late(chunk, begin), schedule_.waiting_groups.late(chunk, begin));
  }
  /// Inlets, and what the cells before outlets hold; before the walls of the chunk.
  void inlets(int chunk, std::vector<OutletAir>& state) const {
    const auto &in = schedule_.inlets, &out = schedule_.outlets;
    apply_inlets(air_, drive_, walls_.parity, in[chunk], in[chunk + 1], p_);
    find_outlet_air(air_, walls_.parity, out[chunk], out[chunk + 1], p_, state);
  }
  /// When the cells beside are collided too. Returns the cells with back-flow.
  std::int64_t outlets(int chunk, const std::vector<OutletAir>& state, const std::vector<double>& heads) const {
    const auto& out = schedule_.outlets;
    return apply_outlets(air_, drive_, state, heads, walls_.parity, out[chunk], out[chunk + 1], p_);
  }

 private:
  void walls(Waiting::Range runs, Waiting::Range groups) const {
    WallInput<T> mine = walls_;
    mine.first = runs.first;
    mine.last = runs.end;
    mine.first_group = groups.first;
    mine.last_group = groups.end;
    kernel_(mine);
  }

  const Drive& drive_;
  const Air& air_;
  const LinkSchedule& schedule_;
  Populations<T>& p_;
  WallInput<T> walls_;
  WallKernel<T> kernel_;
};

KernelReport merged(const std::vector<KernelReport>& reports) {
  KernelReport all;
  for (const KernelReport& r : reports) {
    all.max_speed2 = std::max(all.max_speed2, r.max_speed2);
    all.min_density_excess = std::min(all.min_density_excess, r.min_density_excess);
    all.max_density_excess = std::max(all.max_density_excess, r.max_density_excess);
    all.limited += r.limited;
    all.bad = all.bad || r.bad;
  }
  return all;
}

/// What is left of a step when walls and openings are done.
template <class T>
void end_step(Parity last, Populations<T>& p, Air& air) {
  reflect_at_slip_walls(air.rows, air.links.slip, last, p);
  reflect_at_thin_walls(air.rows, air.links, p);
  p.next = last == Parity::even ? Parity::odd : Parity::even;
  if (air.wall_model) impose_wall_stress(air);
  ++air.steps;
}

}  // namespace

KernelReport collide_and_stream(const CollisionConstants& constants, const Drive& drive, Air& air) {
  prepare_walls(constants, drive, air);
  std::vector<KernelReport> reports(air.rows.chunks().size());
  std::visit(
      [&]<class T>(Populations<T>& p) {
        const Collide<T> collide(constants, drive, air, p);
        for_each_in_parts(static_cast<int>(air.rows.chunks().size()),
                          [&](int c, int) { reports[c] = collide(air.rows.chunks()[c]); });
      },
      air.populations);
  const KernelReport all = merged(reports);
  air.limited += all.limited;
  return all;
}

void apply_links(const Drive& drive, Air& air) {
  blend_partial_cells(air);
  std::visit(
      [&]<class T>(Populations<T>& p) {
        const Parity last = p.next;
        cross_periodic_faces(air.links, last, p);
        // A link writes a place of its own cell alone, and none that another link reads. But outlets take account of
        // the population at rest, to which a wall gives the cell's imbalance: what they need is read first.
        const ApplyLinks<T> apply(drive, air, p);
        std::vector<std::int64_t> backflow(air.rows.chunks().size(), 0);
        std::vector<OutletAir> state(air.links.outlets.size());
        for_each_chunk(air.rows, [&](int c, const Chunk&) { apply.inlets(c, state); });
        const std::vector<double> heads = entering_heads(air, drive, state);
        for_each_chunk(air.rows, [&](int c, const Chunk&) { backflow[c] = apply.outlets(c, state, heads); });
        for_each_chunk(air.rows, [&](int c, const Chunk&) { apply.ready_walls(c, -1); });
        for (const std::int64_t cells : backflow) air.backflow += cells;
        end_step(last, p, air);
      },
      air.populations);
}

KernelReport advance_air(const CollisionConstants& constants, const Drive& drive, Air& air) {
  if (air.partial || air.markers || air.wall_model) {  // they need all cells collided before the links
    const KernelReport report = collide_and_stream(constants, drive, air);
    apply_links(drive, air);
    return report;
  }
  const int chunks = static_cast<int>(air.rows.chunks().size());
  std::vector<KernelReport> reports(chunks);
  std::vector<std::int64_t> backflow(chunks, 0);
  std::vector<OutletAir> state(air.links.outlets.size());
  std::vector<int> begin_of(chunks);  // the first chunk that was collided in one go before it
  std::visit(
      [&]<class T>(Populations<T>& p) {
        const Parity last = p.next;
        const Collide<T> collide(constants, drive, air, p);
        const ApplyLinks<T> apply(drive, air, p);
        for_each_in_parts(chunks, [&](int c, int begin) {
          reports[c] = collide(air.rows.chunks()[c]);
          apply.inlets(c, state);  // before the walls, as in apply_links
          begin_of[c] = begin;
          apply.ready_walls(c, begin);
        });
        cross_periodic_faces(air.links, last, p);
        if (!state.empty()) {
          const std::vector<double> heads = entering_heads(air, drive, state);
          for_each_in_parts(chunks, [&](int c, int) { backflow[c] = apply.outlets(c, state, heads); });
        }
        for_each_in_parts(chunks, [&](int c, int) { apply.late_walls(c, begin_of[c]); });
        end_step(last, p, air);
      },
      air.populations);
  const KernelReport all = merged(reports);
  air.limited += all.limited;
  for (const std::int64_t cells : backflow) air.backflow += cells;
  return all;
}

}  // namespace puffin::lbm
