// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/image.hpp"
#include "cortex/core/image_pool.hpp"
#include "cortex/core/tables.hpp"

#include "mirror/mirror_view.hpp"
#include "wire/messages.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace cortex::comms {

// The values of one agent's simplexes, filled from the blocks of the streams of views and published
// as images. Each simplex is taken from the stream on which it is viewed. What has not come is
// `lost`; what should have come again is `stale`. The mirror's thread writes, and any thread takes
// images.
class MirrorTables {
public:
    MirrorTables(std::shared_ptr<const Structure> structure, const Id& structureHash,
                 const MirrorView& view);

    const Structure& structure() const { return *structure_; }
    // False: the block was refused, because it is not of this structure. Otherwise each simplex in
    // it is applied whole, or not at all where it does not fit its layout.
    bool apply(const Block& block, std::size_t stream, Moment now);
    void markStale(Moment now, std::int64_t period);  // of the agent, ns
    void lose();                                      // to be called when the agent is lost
    void find() { lost_ = false; }                    // and when it is heard again
    // To be called for another view: sequence numbers begin anew, and what it does not show is
    // lost.
    void restart(const MirrorView& view);

    Image newest() { return images_.newest(); }
    // In this view; of a lost agent, of any: what it sent last is all that is known of it.
    bool received(std::uint32_t simplex) const {
        return simplexes_[simplex].received || (lost_ && simplexes_[simplex].ever);
    }
    std::vector<bool> received() const;  // by simplex
    std::vector<bool> behind() const;    // by simplex: of a cycle before that of the newest image
    std::optional<double> age(std::uint32_t simplex, Moment now) const;  // s
    std::uint64_t published() const { return published_; }
    // Blocks that did not come; of the stream of every cycle, cycles.
    std::uint64_t loss() const { return loss_; }
    std::uint64_t refused() const { return refused_; }  // blocks and simplexes in them

private:
    struct Arrival {
        bool received = false, ever = false;
        bool settled = false;       // it came on its own stream
        std::size_t stream = none;  // its own
        std::int64_t cycle = 0;
        Moment when;
        double before = 0;        // s from the measurement to the block
        std::uint32_t every = 1;  // cycles between two writings
    };
    struct Stream {
        std::uint64_t last = 0;  // sequence number; 0: none
        std::int64_t cycle = 0;
    };
    static constexpr std::size_t none = viewRates.size();

    std::uint64_t missingBefore(const Block& block, std::size_t stream) const;
    bool isFromBefore(const Block& block, std::size_t stream) const;
    bool applySimplex(const SimplexData& data, const Block& block, std::size_t stream, Moment now);
    void follow(const Block& block, std::size_t stream);
    bool isTakenFrom(std::size_t stream, const Arrival& simplex) const;
    bool degrade(std::uint32_t simplex, Quality quality);
    void publish();

    std::shared_ptr<const Structure> structure_;
    Id structureHash_;
    Tables tables_;
    ImagePool images_;
    std::vector<Arrival> simplexes_;
    std::array<Stream, viewRates.size()> streams_;
    std::size_t fastest_ = none;  // of the streams that have simplexes of this agent
    bool led_ = false;            // a block of that one has come
    bool lost_ = false;           // the agent
    std::int64_t cycle_ = 0, nominalTime_ = 0, wallClock_ = 0;
    std::uint64_t published_ = 0, loss_ = 0, refused_ = 0;
};

}  // namespace cortex::comms
