// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/image_pool.hpp"
#include "cortex/core/spsc_ring.hpp"

#include <atomic>
#include <cstdint>
#include <utility>

namespace cortex::comms {

// The images of the newest cycles that the communication thread has not sent yet, for streams of
// every cycle. Its room is fixed when it is made. A cycle that finds none is left out, which shows
// as a gap in the numbers of cycles.
class KeptImages {
public:
    explicit KeptImages(ImagePool& images)
        : images_{images}, ring_{imagesToKeep(images.octetsOfImage())} {}

    std::size_t room() const { return ring_.size(); }

    // Loop thread, after the image of a cycle is published.
    void keep() CORTEX_REALTIME {
        if (!wanted_.load(std::memory_order_relaxed)) return;
        Image* const place = ring_.free();
        if (place == nullptr) return;
        *place = images_.newest();
        if (*place) ring_.push();
    }

    // Communication thread: whether images are kept from the next cycle on.
    void want(bool wanted) { wanted_.store(wanted, std::memory_order_relaxed); }
    // Communication thread: the oldest one; empty: there is none.
    Image next() {
        Image* const oldest = ring_.front();
        if (oldest == nullptr) return {};
        Image image = std::move(*oldest);
        ring_.pop();
        return image;
    }

private:
    ImagePool& images_;
    SpscRing<Image> ring_;
    std::atomic<bool> wanted_{false};
};

}  // namespace cortex::comms
