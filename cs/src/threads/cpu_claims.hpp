// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace cortex::cs {

// CPUs that no other loop of this host is to share, as far as loops ask. A claim is a socket with
// the CPU's number for a name, seen in one network namespace, and a lock on a file in each of
// `folders`, seen wherever the folder is shared. It ends with this object, and with its process
// however that ends. Setup, one thread.
class CpuClaims {
public:
    explicit CpuClaims(std::vector<std::string> folders = {"/dev/shm", "/run"});
    ~CpuClaims();
    CpuClaims(const CpuClaims&) = delete;
    CpuClaims& operator=(const CpuClaims&) = delete;

    // The first `count` of these CPUs that nobody has claimed. Empty where there are not so many:
    // then none is claimed.
    std::vector<int> take(const std::vector<int>& cpus, std::size_t count);
    void release();

private:
    struct Held {
        int opened = -1;     // a socket or a file
        std::string path{};  // of a file that we have locked
    };
    static void letGo(const Held& held);
    bool claim(int cpu);  // false: somebody else has it

    std::vector<std::string> folders_;
    std::vector<Held> held_;
};

}  // namespace cortex::cs
