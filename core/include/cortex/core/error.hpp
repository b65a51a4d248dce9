// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/report.hpp"

#include <memory>
#include <stdexcept>
#include <string>

namespace cortex {

// Setup-phase failure that the caller can act on; the message says what to do.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// A handle was used that populate() has not bound; `handle`: its type, `at`: the handle itself,
// where that is known.
class UnboundHandle : public Error {
public:
    explicit UnboundHandle(const std::string& handle, const void* at = nullptr);

    const std::string& handle() const { return *handle_; }
    const void* at() const { return at_; }

private:
    std::shared_ptr<const std::string> handle_;
    const void* at_;
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
