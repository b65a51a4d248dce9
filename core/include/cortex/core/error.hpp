// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/report.hpp"

#include <stdexcept>
#include <string>

namespace cortex {

// Setup-phase failure that the caller can act on; the message says what to do.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// A handle was used that populate() has not bound; `handle`: its type.
class UnboundHandle : public Error {
public:
    explicit UnboundHandle(const char* handle);

    const char* handle() const { return handle_; }

private:
    const char* handle_;
};

// The model (ontology, morphology or system) is refused; the report lists every finding.
class ModelError : public Error {
public:
    explicit ModelError(Report report);

    const Report& report() const { return report_; }

private:
    Report report_;
};

}  // namespace cortex
