# SPDX-License-Identifier: GPL-3.0-or-later
# Run when a Debian package is put together: writes changelog.gz, which is CHANGELOG.md, and changelog.Debian.gz, which says
# of which commit the package was made, into FOLDER/sphverify. What it needs is set before: source, version, folder.
include("${source}/cmake/DescribeCommit.cmake")
sphverify_describe_commit("${source}" commit date)
if(NOT date)
  string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
endif()
set(folder "${folder}/sphverify")
configure_file("${source}/CHANGELOG.md" "${folder}/changelog" COPYONLY)
file(WRITE "${folder}/changelog.Debian" "sphverify (${version}) bookworm; urgency=medium

  * Made of commit ${commit}; what is new stands in changelog.gz.

 -- The sphverify developers <developers@sphverify.invalid>  ${date}
")
execute_process(COMMAND gzip --force --best --no-name "${folder}/changelog" "${folder}/changelog.Debian"
                COMMAND_ERROR_IS_FATAL ANY)
