// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/report.hpp"
#include "cortex/core/type_model.hpp"

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace cortex {

// A system file as written. Values stay text until the tree knows the types.
struct SystemDescription {
    struct Relate {
        std::string rule, to;
        bool delayed = false;
        bool remote = false;  // `to` may belong to another agent, bound when it appears
        Place place;
        std::string type{};  // that it has there; the rule's target if empty
        double maxAge = 0;   // s; 0: the rule's
    };
    struct Setting {
        std::string data, value;
        Place place;
        bool escaped = false;  // in the file; `value` is what it stands for
    };
    struct SimplexEntry {
        std::string path, type;
        int every = 1;
        int phase = -1;  // -1: spread over `every` by canonical order
        std::vector<Relate> relates;
        std::vector<Setting> settings;
        Place place;
    };
    // Attributes of `<cluster>`: frequency, threads, priority, overflow, …, checked by who uses
    // them.
    struct ClusterEntry {
        std::string name;
        std::map<std::string, std::string> attributes;
        Place place;
    };
    std::string name;
    std::vector<ClusterEntry> clusters;
    std::vector<SimplexEntry> simplexes;
    Place place;
};

// Any number of ontology, morphology and system files, with what they include, read once each.
struct ModelFiles {
    TypeModel types;
    SystemDescription system;
    bool hasSystem = false;
    std::vector<std::filesystem::path> files;  // all that were read
};

// Never throws for bad content: everything wrong is in the report, and what could be read is in the
// result. Bounds (docs/ontology.md): 16 MiB a file, 32 levels of nesting, 256 files.
ModelFiles readModelFiles(std::span<const std::filesystem::path> files, Report& report);

}  // namespace cortex
