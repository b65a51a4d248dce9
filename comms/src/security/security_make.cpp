// SPDX-License-Identifier: Apache-2.0
#include "cortex/comms/network_options.hpp"
#include "cortex/comms/security.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/simplex_tree.hpp"

#include "security/security_documents.hpp"
#include "security/security_folder.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace cortex::comms {
namespace {

namespace fs = std::filesystem;
namespace files = security_files;

constexpr std::size_t longestName = 48;  // leaves room for the host and process of a tool
constexpr std::time_t secondsOfDay = 86'400;

// A new folder. It is removed again unless everything in it could be written.
class NewFolder {
public:
    explicit NewFolder(fs::path folder) : folder_{std::move(folder)} {
        if (mkdir(folder_.c_str(), 0700) == 0) return;
        const std::string why = std::strerror(errno);
        throw Error{"cannot make the folder '" + folder_.string() + "': " + why +
                    (errno == EEXIST ? "; nothing is ever overwritten: name another one" : "")};
    }
    ~NewFolder() {
        std::error_code ignored;
        if (!done_) fs::remove_all(folder_, ignored);
    }
    NewFolder(const NewFolder&) = delete;
    NewFolder& operator=(const NewFolder&) = delete;

    void write(const char* name, const std::string& text, unsigned mode = 0644) {
        const fs::path file = folder_ / name;
        const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        const auto size = static_cast<ssize_t>(text.size());
        const bool written =
            descriptor >= 0 && ::write(descriptor, text.data(), text.size()) == size;
        const bool closed = descriptor >= 0 && close(descriptor) == 0;
        if (!written || !closed) {
            throw Error{"cannot write '" + file.string() + "': " + std::strerror(errno)};
        }
    }
    void writeKey(const char* name, const EVP_PKEY* key) { write(name, pemOf(key), 0600); }
    void done() { done_ = true; }

private:
    fs::path folder_;
    bool done_ = false;
};

struct Signer {
    Certificate certificate;
    Key key;
};

Signer newAuthority(const std::string& name, std::time_t until) {
    Key key = newKey();
    Certificate certificate = newCertificate(name, key.get(), nullptr, key.get(), until);
    return {std::move(certificate), std::move(key)};
}

Signer signerFrom(const fs::path& folder, const char* certificateFile, const char* keyFile) {
    const std::string where = " in '" + folder.string() + "'";
    for (const fs::path& each : {folder, folder / certificateFile, folder / keyFile}) {
        if (const std::string why = changeableByOthers(each); !why.empty()) throw Error{why};
    }
    Signer signer{certificateFrom(contentOf(folder / certificateFile)),
                  keyFrom(contentOf(folder / keyFile))};
    if (!signer.certificate || !signer.key ||
        !isKeyOf(signer.key.get(), signer.certificate.get())) {
        throw Error{std::string{certificateFile} + " and " + keyFile + where +
                    " are no certificate with its key"};
    }
    if (endOf(signer.certificate.get()) <= std::time(nullptr)) {
        throw Error{std::string{certificateFile} + where + " has expired, on " +
                    utcText(endOf(signer.certificate.get())) +
                    "; make a new authority, and the folders of all agents anew"};
    }
    return signer;
}

void check(const AgentRights& rights, int days) {
    const std::string& name = rights.agent;
    const std::string wrong = SimplexTree::pathError("/" + name);
    if (!wrong.empty() || name.find('/') != std::string::npos || name.size() > longestName) {
        throw Error{"'" + name + "' cannot name an agent: use A-Z a-z 0-9 _ -, at most " +
                    std::to_string(longestName) + " characters"};
    }
    for (const auto* prefixes : {&rights.mayCommand, &rights.owns}) {
        for (const std::string& prefix : *prefixes) {
            const std::string no = prefix == "/" ? "" : SimplexTree::pathError(prefix);
            if (!no.empty()) throw Error{"'" + prefix + "' is no path: " + no};
        }
    }
    for (const int domain : rights.domains) {
        if (domain < 0 || domain > lastDomain) {
            throw Error{"there is no domain " + std::to_string(domain) + "; choose 0 to " +
                        std::to_string(lastDomain)};
        }
    }
    if (days < 1) throw Error{"a certificate is valid for at least one day"};
}

}  // namespace

void createAuthority(const fs::path& folder, int days) {
    if (days < 1) throw Error{"an authority is valid for at least one day"};
    const std::time_t until = std::time(nullptr) + days * secondsOfDay;
    const Signer identities = newAuthority("identity authority", until);
    const Signer rights = newAuthority("permissions authority", until);
    NewFolder made{folder};
    made.write(files::identityAuthority, pemOf(identities.certificate.get()));
    made.writeKey(files::identityAuthorityKey, identities.key.get());
    made.write(files::permissionsAuthority, pemOf(rights.certificate.get()));
    made.writeKey(files::permissionsAuthorityKey, rights.key.get());
    made.write(files::governance,
               signedText(governance(), rights.certificate.get(), rights.key.get()));
    made.done();
}

AgentRights createAgent(const fs::path& authority, const fs::path& folder, AgentRights rights,
                        int days) {
    check(rights, days);
    if (!fs::is_directory(authority)) {
        throw Error{"there is no authority '" + authority.string() +
                    "'; make one: cortex security create-authority " + authority.string()};
    }
    const Signer identities =
        signerFrom(authority, files::identityAuthority, files::identityAuthorityKey);
    const Signer permits =
        signerFrom(authority, files::permissionsAuthority, files::permissionsAuthorityKey);
    const std::string governed = contentOf(authority / files::governance);
    if (!verifiedText(governed, permits.certificate.get())) {
        throw Error{std::string{files::governance} + " in '" + authority.string() +
                    "' was changed; make a new authority"};
    }
    const std::time_t end =
        std::min({std::time(nullptr) + days * secondsOfDay, endOf(identities.certificate.get()),
                  endOf(permits.certificate.get())});
    rights.until = utcText(end);
    const auto sign = [&](const std::string& text) {
        return signedText(text, permits.certificate.get(), permits.key.get());
    };
    const Key key = newKey();
    NewFolder made{folder};
    made.write(files::identityAuthority, pemOf(identities.certificate.get()));
    made.write(files::permissionsAuthority, pemOf(permits.certificate.get()));
    made.write(files::certificate,
               pemOf(newCertificate(rights.agent, key.get(), identities.certificate.get(),
                                    identities.key.get(), end)
                         .get()));
    made.writeKey(files::key, key.get());
    made.write(files::governance, governed);
    made.write(files::permissions, sign(permissions(rights)));
    made.write(files::commands, sign(textOf({rights, publicText(key.get())})));
    made.done();
    return rights;
}

}  // namespace cortex::comms
