// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <openssl/types.h>

// Everything that CorteX does with OpenSSL; no other file calls it. Functions that make something
// throw Error. Those that examine what others made return false or nothing.
namespace cortex::comms {

struct FreeOpenSsl {
    void operator()(X509* certificate) const;
    void operator()(EVP_PKEY* key) const;
};
using Certificate = std::unique_ptr<X509, FreeOpenSsl>;
using Key = std::unique_ptr<EVP_PKEY, FreeOpenSsl>;

Key newKey();  // P-256
// For "CN=name,O=CorteX". It signs itself if `issuer` is null.
Certificate newCertificate(const std::string& name, const EVP_PKEY* key, X509* issuer,
                           EVP_PKEY* issuerKey, std::time_t until);
std::string pemOf(const X509* certificate);
std::string pemOf(const EVP_PKEY* key);
Certificate certificateFrom(const std::string& pem);  // null: it is none
Key keyFrom(const std::string& pem);                  // a private one

// S/MIME with readable text, as DDS-Security has it. None: the text was changed, or somebody else
// signed it.
std::string signedText(const std::string& text, X509* signer, EVP_PKEY* key);
std::optional<std::string> verifiedText(const std::string& smime, X509* signer);

bool isIssuedBy(X509* certificate, X509* issuer);  // its signature, not its dates
bool isKeyOf(const EVP_PKEY* key, const X509* certificate);
std::time_t beginOf(const X509* certificate);
std::time_t endOf(const X509* certificate);
std::string commonName(const X509* certificate);
std::string subjectOf(const X509* certificate);  // RFC 2253
// SHA-256 of the encoded subject of newCertificate(name, …).
std::array<std::uint8_t, 32> subjectDigest(const std::string& name);

using Octets = std::vector<std::uint8_t>;
std::string publicText(const EVP_PKEY* key);  // the public half
Key keyFromPublicText(const std::string& text);
std::string base64(std::span<const std::uint8_t> octets);
std::optional<Octets> fromBase64(const std::string& text);
std::string signatureOf(std::span<const std::uint8_t> octets, EVP_PKEY* key);  // base64
bool isSignature(const std::string& signature, std::span<const std::uint8_t> octets, EVP_PKEY* key);

}  // namespace cortex::comms
