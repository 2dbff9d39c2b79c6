#pragma once
// Air that flows through the live band behind a wall (markers.hpp), as scalars see it: they must not enter the band.
//
// Each cell of the band is reckoned to the fluid cell that is nearest to it through open faces, its root. What the
// lattice moves between two cells is booked as a flux between their roots, along the shortest way through fluid cells.
// Faces to and inside the band are closed for scalars. So the fluxes through fluid faces balance the change of density
// of each fluid cell and its part of the band: a constant concentration stays constant but for the air that the
// compressibility stores in the band.

#include <array>
#include <cstdint>
#include <vector>

#include "lbm/rows.hpp"

namespace puffin::lbm {

struct Air;
struct FaceFluxes;

/// Face `axis` of slot `face`, as in FaceFluxes.
struct BookedFace {
  std::ptrdiff_t face = 0;
  std::int8_t axis = 0;
  std::int8_t sign = 1;
};

struct BandFluxes {
  std::array<std::vector<std::uint8_t>, 3> open;  // faces between computed cells, the band's too; empty: no band
  std::vector<BookedFace> to;                     // fluid faces that gain
  std::vector<std::int32_t> first{0};             // of `from`, one more than `to`
  std::vector<BookedFace> from;                   // band faces
  std::size_t unbooked = 0;                       // band faces between roots that no short way joins
};

/// Finds the bookings; closes the band's faces in `fluxes.open`, which holds all faces between computed cells.
BandFluxes find_band_fluxes(const Air& air, FaceFluxes& fluxes);

/// Adds what flows through the band to the fluid faces.
void book_band_fluxes(const BandFluxes& band, FaceFluxes& fluxes);

}  // namespace puffin::lbm
