// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace cortex::cs {

// CPUs that no other loop of this host is to share, as far as loops ask. A claim is a socket with
// the CPU's number for a name: it ends with this object, and with its process however that ends.
// Setup, one thread. Network namespaces do not see each other's claims.
class CpuClaims {
public:
    CpuClaims() = default;
    ~CpuClaims();
    CpuClaims(const CpuClaims&) = delete;
    CpuClaims& operator=(const CpuClaims&) = delete;

    // The first `count` of these CPUs that nobody has claimed. Empty where there are not so many:
    // then none is claimed.
    std::vector<int> take(const std::vector<int>& cpus, std::size_t count);
    void release();

private:
    bool claim(int cpu);  // false: somebody else has it

    std::vector<int> sockets_;
};

}  // namespace cortex::cs
