//! Independent checker of viewcert certificates.
