#pragma once
// The chain of live contacts of each carrier, threaded through the list of contacts.

#include "dem/state.hpp"

namespace puffin::dem {

/// Calls use(place of contact) for each contact of the carrier.
template <class Use>
void for_each_contact(const State& state, std::int32_t carrier, Use use) {
  for (std::int32_t c = state.first_contact[carrier]; c >= 0;) {
    const Contact& contact = state.contacts[c];
    const std::int32_t next = contact.a == carrier ? contact.next_a : contact.next_b;
    use(c);
    c = next;
  }
}

/// Puts a contact into the list and into the chains of its carriers; returns its place.
std::int32_t link(const Contact& contact, State& state);

/// Takes a contact out of the chains and frees its place.
void unlink(std::int32_t place, State& state);

/// Sum of the contact forces on a carrier at the end of the last step [N].
Eigen::Vector3d contact_force(const State& state, std::int32_t carrier);

}  // namespace puffin::dem
