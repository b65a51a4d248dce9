// SPDX-License-Identifier: Apache-2.0
#include "dry_start.hpp"

#include "cortex/core/error.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string_view>

#include <fcntl.h>
#include <unistd.h>

namespace cortex::toolkit {
namespace {

struct StartEnded {};

[[noreturn]] void failed(const char* doing) {
    throw Error(std::string{doing} + ": " + std::strerror(errno));
}

}  // namespace

void dryStart(const CommandLine& line, const ClassRegistry& registry, SimplexTree& tree,
              const std::function<void(cs::ClusterCS&)>& look) {
    const ClusterSettings settings = clusterSettings(tree.description(), line);
    cs::ClusterCS cluster{settings.name, settings.options};
    cluster.addSimplexTree(tree);
    cluster.useClasses(registry);
    cluster.setTriggerSource<cs::ManualTrigger>(settings.period);
    cluster.beforeFirstCycle([&] {
        look(cluster);
        throw StartEnded{};
    });
    try {
        cluster.start();
    } catch (const StartEnded&) {
        return;
    }
}

OutputAside::OutputAside()
    : descriptor_{(std::fflush(stdout), fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0))} {
    if (descriptor_ < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0)
        failed("the standard output cannot be set aside");
}

OutputAside::~OutputAside() { close(descriptor_); }

void OutputAside::write(const std::string& text) const {
    for (std::string_view rest = text; !rest.empty();) {
        const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) failed("the standard output cannot be written");
        rest.remove_prefix(static_cast<std::size_t>(written));
    }
}

}  // namespace cortex::toolkit
