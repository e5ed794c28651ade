# The tool's manual pages (compressed, as Debian has them) and completions, made from its own help and installed with it.
find_program(TVG_GZIP gzip)
# Every command is a file of its own, NAME_command.cpp.
get_target_property(commands tvg_tool SOURCES)
list(FILTER commands INCLUDE REGEX "_command\\.cpp$")
list(TRANSFORM commands REPLACE "_command\\.cpp$" "")
set(texts ${CMAKE_CURRENT_BINARY_DIR}/texts)
file(MAKE_DIRECTORY ${texts})

set(pages "")
if(TVG_GZIP)
  list(TRANSFORM commands PREPEND tvg- OUTPUT_VARIABLE names)
  foreach(name IN LISTS names ITEMS tvg)
    string(REGEX REPLACE "^tvg-?" "" command ${name})
    add_custom_command(OUTPUT ${texts}/${name}.1.gz
      COMMAND tvg_tool help --man ${command} > ${texts}/${name}.1
      COMMAND ${TVG_GZIP} -9nf ${texts}/${name}.1
      DEPENDS tvg_tool VERBATIM)
    list(APPEND pages ${texts}/${name}.1.gz)
  endforeach()
endif()

set(completions bash/tvg zsh/_tvg fish/tvg.fish)
set(scripts "")
foreach(completion IN LISTS completions)
  cmake_path(GET completion PARENT_PATH shell)
  file(MAKE_DIRECTORY ${texts}/${shell})
  add_custom_command(OUTPUT ${texts}/${completion}
    COMMAND tvg_tool help --completion ${shell} > ${texts}/${completion}
    DEPENDS tvg_tool VERBATIM)
  list(APPEND scripts ${texts}/${completion})
endforeach()
add_custom_target(tvg_texts ALL DEPENDS ${pages} ${scripts})

install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tool)
install(FILES ${texts}/bash/tvg DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT tool)
install(FILES ${texts}/zsh/_tvg DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT tool)
install(FILES ${texts}/fish/tvg.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT tool)
