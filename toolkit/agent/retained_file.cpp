// SPDX-License-Identifier: Apache-2.0
#include "retained_file.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/labelled_value.hpp"
#include "cortex/core/model_files.hpp"
#include "cortex/core/xml_text.hpp"

#include "stored_values.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <iostream>
#include <iterator>
#include <utility>

namespace cortex::toolkit {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// A model is not set aside as a file of values with errors in it. "" or what the file is.
std::string otherThanValues(const fs::path& file) {
    Report ignored;
    const std::array files{file};
    const ModelFiles model = readModelFiles(files, ignored);
    const std::string& name = model.system.name;
    const bool isValues = name == "retained" || name == "saved";
    const bool isModel = model.hasSystem ? !isValues : !model.types.types().empty();
    if (!isModel) return "";
    return file.string() + " is " +
           (model.hasSystem ? "the system file of '" + name + "'"
                            : std::string{"a file of types"}) +
           ", and would be replaced: name another file";
}

// As told, or with a number where something has that name.
fs::path freeName(const std::string& name) {
    std::error_code none;
    fs::path free = name;
    for (int n = 2; fs::exists(fs::symlink_status(free, none)); ++n) {
        free = name + "-" + std::to_string(n);
    }
    return free;
}

std::string contentOf(const fs::path& file) {
    std::ifstream stream{file, std::ios::binary};
    return {std::istreambuf_iterator<char>{stream}, {}};
}

constexpr Repeating::Pause interval{1000};

bool isRetained(const ItemLayout& each) { return each.item->retain; }

}  // namespace

bool RetainedFile::hasItems(const SimplexTree& tree) {
    return std::ranges::any_of(tree.simplexes(), [](const auto& each) {
        return std::ranges::any_of(each.second->type().data, &DataItem::retain);
    });
}

std::string RetainedFile::restore(SimplexTree& tree, bool keeps) {
    if (const std::string other = otherThanAFile(file_); !other.empty()) {
        throw Error("--retain: " + other);
    }
    std::error_code none;
    if (!fs::exists(fs::symlink_status(file_, none))) return {};
    if (const std::string other = otherThanValues(file_); !other.empty()) {
        throw Error("--retain: " + other);
    }
    known_ = contentOf(file_);
    Report report;
    const std::vector<StoredValue> values = readStored(file_, retainedItems, tree, report);
    std::string lines = applyStored(values);
    for (const StoredValue& each : values) {
        good_[each.simplex->path() + "." + each.item->name] = toText(each.value);
    }
    if (!lines.empty()) lines.insert(0, "retained in " + file_.string() + ":\n");
    if (report.ok()) return lines;
    if (!keeps) {
        std::cerr << report.text() << file_.string() << ": has what cannot be restored; "
                  << values.size() << " good values of it count" << std::endl;
        return lines;
    }
    const fs::path broken = freeName(file_.string() + ".broken");
    fs::rename(file_, broken, none);
    known_ = contentOf(file_);
    std::cerr << report.text() << file_.string() << ": has what cannot be restored; "
              << (none ? "it cannot be set aside: " + none.message()
                       : "it was set aside as " + broken.string())
              << ", and " << values.size() << " good values of it count" << std::endl;
    return lines;
}

bool RetainedFile::hasChanged() const {
    const std::lock_guard lock{mutex_};
    return contentOf(file_) != known_;
}

void RetainedFile::keep(cs::ClusterCS& cluster) {
    cluster_ = &cluster;
    looked_ = Clock::now();
    writing_.start("cortex-retain", interval, [this] {
        write(Last::No);
        return interval;
    });
}

void RetainedFile::finish() {
    if (writing_.finish()) write(Last::Yes);
}

// After a standstill another start may have taken over. If that one is still there, the network
// says so within a second; if it has ended, the file is its only word.
void RetainedFile::write(Last last) {
    const std::lock_guard lock{mutex_};
    const Clock::time_point before = std::exchange(looked_, Clock::now());
    const bool stoodStill = looked_ - before >= 2 * interval;
    isDoubtful_ = isDoubtful_ || stoodStill;
    if (away_ || isOld_ || (stoodStill && last == Last::No)) return;
    if (std::exchange(isDoubtful_, false)) {
        const std::string there = contentOf(file_);
        isOld_ = !there.empty() && there != known_;
        if (isOld_) return;
    }
    try {
        const std::string text = textOf(cluster_->image());
        if (text == contentOf(file_)) return;
        const std::string problem = replaceFile(file_, text);
        if (problem.empty()) known_ = text;
        trouble_.tell(problem);
    } catch (const Error& error) {
        trouble_.tell(error.what());  // too many images are held: in a second again
    }
}

// The form of `cortex save`. What is out of its range, or no number, keeps its last good value.
std::string RetainedFile::textOf(const Image& image) {
    std::string text =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- Retained items; cortex-agent writes this "
        "file. -->\n<system name=\"retained\">\n";
    const Structure& structure = image.structure();
    for (std::uint32_t i = 0; i < structure.simplexes.size(); ++i) {
        const SimplexInfo& info = structure.simplexes[i];
        if (info.remote || std::ranges::none_of(info.layout->items, isRetained)) continue;
        text += "  <simplex path=\"" + info.path + "\" type=\"" + info.layout->type->name + "\">\n";
        for (const ItemLayout& each : info.layout->items) {
            if (!isRetained(each)) continue;
            const Value value = image.value(i, each);
            std::string& good =
                good_.try_emplace(info.path + "." + each.item->name, toText(each.item->initial))
                    .first->second;
            if (valueError(*each.item, value).empty()) good = toText(value);
            text += "    " + setElement(each.item->name, good) + "\n";
        }
        text += "  </simplex>\n";
    }
    return text + "</system>\n";
}

}  // namespace cortex::toolkit
