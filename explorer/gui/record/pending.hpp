// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include "record/recorded_item.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace cortex::gui {

// What came of one start of one agent since it was taken last: some values an image.
struct PendingRows {
    std::string agent;
    std::int64_t epoch = 0;
    std::vector<RecordedItem> items;                 // in the order of the values
    std::vector<std::int64_t> cycles, nominal, utc;  // of each image; ns
    std::vector<std::int64_t> came;                  // when it came, by our clock; UTC ns
    std::vector<double> values;                      // of one image after the other
    std::vector<std::uint8_t> qualities;
};

// Carries the values of recorded items from whoever hears them to the thread of the window. It
// copies and returns: what the window does not fetch in time is not kept. Any thread.
class Pending {
public:
    static constexpr std::size_t usual = 4'000'000;  // values; a second of 4,000 lines

    explicit Pending(std::size_t most = usual) : most_{most} {}  // values of an agent

    void record(std::vector<RecordedItem> items);  // these, from now on
    // `came`: when, in UTC ns of our clock; none: as soon as it was taken.
    void hear(const std::string& agent, const comms::AgentImage& image,
              std::optional<std::int64_t> came = {});
    std::vector<PendingRows> take();
    std::uint64_t dropped() const;  // images for which there was no room
    // Texts stand for numbers in their order: the number of a text is its place here.
    std::vector<std::string> texts() const;
    std::vector<std::string> paths() const;  // of all that is recorded, each once

private:
    struct Source {
        std::uint32_t simplex = noSimplex;
        Kind kind = Kind::Float;
        std::uint32_t offset = 0;  // of the element
        bool constant = false;
        bool always = false;  // the framework writes it, whatever the quality of the simplex
    };
    struct Agent {
        std::vector<Source> sources;
        PendingRows rows;
    };
    Agent& agentOf(const std::string& name, const Structure& structure);
    static Source sourceOf(const RecordedItem& item, const Structure& structure);
    double number(const Image& image, const Source& source, const RecordedItem& item);
    double numberOf(const std::string& text);
    void add(PendingRows& rows, const comms::AgentImage& image, const Source& source,
             const RecordedItem& item);

    const std::size_t most_;
    mutable std::mutex mutex_;
    std::vector<RecordedItem> items_;
    std::map<std::string, Agent, std::less<>> agents_;
    std::vector<PendingRows> done_;  // of earlier starts and earlier items
    std::vector<std::string> texts_;
    std::map<std::string, std::size_t, std::less<>> numbers_;
    std::uint64_t dropped_ = 0;
};

}  // namespace cortex::gui
