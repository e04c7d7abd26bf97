# Run by cpack on what it is about to pack: readable for everybody, whatever the umask of whoever
# makes the package.
execute_process(COMMAND chmod -R u=rwX,go=rX ${CPACK_TEMPORARY_DIRECTORY} COMMAND_ERROR_IS_FATAL ANY)
