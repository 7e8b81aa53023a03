// Names of the files that a process needs in a secured fleet (`skein run --secure`). Each process has a folder with
// these files. The names are those of an enclave of ROS 2's SROS2, so that ROS 2 nodes can use such a folder, too.
#pragma once

#include <array>

namespace skein::security_files {

inline constexpr const char* kIdentityCa = "identity_ca.cert.pem";        ///< certificate of the CA for identities
inline constexpr const char* kCertificate = "cert.pem";                   ///< the process's certificate (identity)
inline constexpr const char* kKey = "key.pem";                            ///< the process's private key
inline constexpr const char* kPermissionsCa = "permissions_ca.cert.pem";  ///< CA that signs the two following files
inline constexpr const char* kGovernance = "governance.p7s";              ///< what DDS protects in each domain, and how
inline constexpr const char* kPermissions = "permissions.p7s";  ///< topics that the process may read and write

inline constexpr std::array kAll = {kIdentityCa, kCertificate, kKey, kPermissionsCa, kGovernance, kPermissions};

}  // namespace skein::security_files
