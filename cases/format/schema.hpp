#pragma once
// Every key of the case file with its unit, its range and its default: the only place where defaults live.

#include "cases/case.hpp"
#include "cases/format/fields.hpp"

namespace puffin::cases::format {

void describe(Fields& io, Case& c);                                            // schema.cpp: the whole file
void describe(Fields& io, Geometry& g);                                        // schema.cpp
void describe(Fields& io, Stop& s);                                            // schema.cpp
void describe(Fields& io, Output& o, const Case& c);                           // schema_output.cpp
void describe(Fields& io, Air& a);                                             // schema_air.cpp
void describe(Fields& io, Numerics& n, AirModel air);                          // schema_air.cpp
void describe(Fields& io, Carriers& c);                                        // schema_carriers.cpp
void describe(Fields& io, Fines& f, const std::optional<Carriers>& carriers);  // schema_carriers.cpp

/// The parameters of a generator: everything in the table is one.
void describe_parameters(Fields& io, const std::string& kind, std::map<std::string, Parameter>& parameters);

}  // namespace puffin::cases::format
