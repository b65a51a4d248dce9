// SPDX-License-Identifier: Apache-2.0
#include "retained_file.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/labelled_value.hpp"
#include "cortex/core/model_files.hpp"
#include "cortex/core/service_threads.hpp"
#include "cortex/core/xml_text.hpp"

#include "stored_values.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <iostream>
#include <string_view>

#include <fcntl.h>
#include <unistd.h>

namespace cortex::toolkit {
namespace {

namespace fs = std::filesystem;

// A descriptor that is closed with its block; -1 where it could not be opened.
class OpenFile {
public:
    OpenFile(const fs::path& path, int flags)
        : file_{open(path.c_str(), flags | O_CLOEXEC, 0644)} {}
    ~OpenFile() {
        if (file_ >= 0) close(file_);
    }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;

    bool writeAll(std::string_view text) const {
        while (file_ >= 0 && !text.empty()) {
            const ssize_t size = ::write(file_, text.data(), text.size());
            if (size < 0 && errno != EINTR) return false;
            if (size > 0) text.remove_prefix(static_cast<std::size_t>(size));
        }
        return file_ >= 0;
    }
    bool sync() const { return file_ >= 0 && fsync(file_) == 0; }

private:
    int file_;
};

// A new file takes the place of the old one: of /dev/null as well, where we may do so.
std::string otherThanAFile(const fs::path& path) {
    std::error_code none;
    switch (fs::symlink_status(path, none).type()) {
        case fs::file_type::regular:
        case fs::file_type::not_found:
            return "";
        case fs::file_type::symlink:
            return path.string() + " is a symbolic link, which would be replaced: name the file";
        case fs::file_type::directory:
            return path.string() + " is a folder: name a file in it";
        default:
            return path.string() +
                   " is no regular file, and would be replaced by one: name another file";
    }
}

// In one step: after a power failure the file is the old or the new one. "" or why it is the old.
std::string replaceFile(const fs::path& file, const std::string& text) {
    const fs::path next = file.string() + ".new";
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path{"."};
    if (std::string other = otherThanAFile(file); !other.empty()) return other;
    if (std::error_code none; !fs::exists(folder, none)) {
        return "the folder " + folder.string() + " is missing: mkdir -p " + folder.string() +
               ", and they are written within a second";
    }
    const auto failed = [&] { return file.string() + ": " + std::strerror(errno); };
    {
        const OpenFile output{next, O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW};
        if (!output.writeAll(text) || !output.sync()) return failed();
    }
    if (std::rename(next.c_str(), file.c_str()) != 0) return failed();
    return OpenFile{folder, O_RDONLY | O_DIRECTORY}.sync() ? "" : failed();
}

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

bool isRetained(const ItemLayout& each) { return each.item->retain; }

}  // namespace

RetainedFile::~RetainedFile() {
    if (thread_.joinable()) finish();
}

bool RetainedFile::hasItems(const SimplexTree& tree) {
    return std::ranges::any_of(tree.simplexes(), [](const auto& each) {
        return std::ranges::any_of(each.second->type().data, &DataItem::retain);
    });
}

std::string RetainedFile::restore(SimplexTree& tree) {
    if (const std::string other = otherThanAFile(file_); !other.empty()) {
        throw Error("--retain: " + other);
    }
    std::error_code none;
    if (!fs::exists(fs::symlink_status(file_, none))) return {};
    if (const std::string other = otherThanValues(file_); !other.empty()) {
        throw Error("--retain: " + other);
    }
    Report report;
    const std::vector<StoredValue> values = readStored(file_, retainedItems, tree, report);
    std::string lines = applyStored(values);
    for (const StoredValue& each : values) {
        good_[each.simplex->path() + "." + each.item->name] = toText(each.value);
    }
    if (!lines.empty()) lines.insert(0, "retained in " + file_.string() + ":\n");
    if (report.ok()) return lines;
    const fs::path broken = freeName(file_.string() + ".broken");
    fs::rename(file_, broken, none);
    std::cerr << report.text() << file_.string() << ": has what cannot be restored; "
              << (none ? "it cannot be set aside: " + none.message()
                       : "it was set aside as " + broken.string())
              << ", and " << values.size() << " good values of it count" << std::endl;
    return lines;
}

void RetainedFile::keep(cs::ClusterCS& cluster) {
    cluster_ = &cluster;
    const ServiceThreads named{"cortex-retain"};
    thread_ = std::thread{[this] { run(); }};
}

void RetainedFile::finish() {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock{mutex_};
        ending_ = true;
    }
    wake_.notify_all();
    thread_.join();
    write();
}

void RetainedFile::run() {
    constexpr std::chrono::seconds interval{1};
    std::unique_lock lock{mutex_};
    while (!wake_.wait_for(lock, interval, [this] { return ending_; })) {
        lock.unlock();
        write();
        lock.lock();
    }
}

void RetainedFile::write() {
    try {
        const std::string text = textOf(cluster_->image());
        if (text == written_) return;
        const std::string problem = replaceFile(file_, text);
        if (problem.empty()) written_ = text;
        tell(problem);
    } catch (const Error& error) {
        tell(error.what());  // too many images are held: in a second again
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

// Once for each reason.
void RetainedFile::tell(const std::string& problem) {
    if (problem != problem_ && !problem.empty()) {
        std::cerr << "retained items are not written: " << problem << std::endl;
    } else if (!problem_.empty() && problem.empty()) {
        std::cerr << "retained items are written again: " << file_.string() << std::endl;
    }
    problem_ = problem;
}

}  // namespace cortex::toolkit
